#include "apps/bench/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/common.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

constexpr std::size_t least_seeds = 1000, most_seeds = 10'000'000;
constexpr std::size_t first_seeds = 1000;      // of the first result
constexpr std::size_t counted_seeds = 10'000;  // on whose cells the work is counted

class RowTimer {
 public:
  RowTimer(const BenchTask& task, BenchRow& row) : task_(task), row_(row) {}

  void run(WorkCounts& counts) {
    first_result();
    const io::SeedTable seeds = white_seeds(task_.domain->domain, row_.n);
    time_once(seeds, true);  // makes room for the results; not counted
    time(seeds);
    row_.state = host_state();
    row_.build = diagram_->device().build_seconds();
    row_.work = count(counts);
  }

 private:
  // Includes opening the device and building kernels, as in a program that starts; then once more with
  // adjacency, to build the kernels for that too.
  void first_result() {
    const io::SeedTable seeds = white_seeds(task_.domain->domain, std::min(task_.n, first_seeds));
    Stopwatch watch;
    diagram_.emplace(task_.open(), task_.domain->domain, task_.options);
    diagram_->set_seeds(seeds.view());
    diagram_->measures();
    row_.first_result = watch.lap();
    row_.neighbors = neighbors_name(diagram_->neighbors());
    check(nullptr);
    time_once(seeds, true);
  }

  // Both kinds in turn: what disturbs the machine for a while meets both.
  void time(const io::SeedTable& seeds) {
    std::optional<Measures> before;
    const auto run = [&](TimedRuns& runs, bool adjacency) {
      if (enough(runs, task_.limits)) return false;
      runs.seconds.push_back(time_once(seeds, adjacency));
      if (runs.seconds.back() <= runs.best()) runs.phases = diagram_->timings();
      check(before ? &*before : nullptr);
      if (!before) before = diagram_->measures();
      return true;
    };
    for (bool more = true; more;) {
      more = run(row_.measures, false);
      more = run(row_.adjacency, true) || more;
    }
  }

  double time_once(const io::SeedTable& seeds, bool adjacency) {
    return app::time_once(*diagram_, seeds, adjacency);
  }

  void check(const Measures* before) {
    const Measures& measures = diagram_->measures();
    row_.relative_error = std::max(row_.relative_error, measures.relative_error());
    const std::string fault = fault_of(measures, diagram_->precision(), before);
    if (!fault.empty()) throw Error(ErrorCode::internal, fault);
  }

  Work count(WorkCounts& counts) {
    const auto key = std::pair(task_.name, row_.n);
    if (const auto known = counts.find(key); known != counts.end()) return known->second;
    const std::size_t n = std::min(row_.n, counted_seeds);
    const Domain part = part_of(*task_.domain, static_cast<double>(n) / static_cast<double>(row_.n));
    const io::SeedTable seeds = white_seeds(part, n);
    Diagram diagram(diagram_->device(), part, task_.options);
    diagram.set_seeds(seeds.view());
    return counts[key] = count_work(part, diagram.cells(), seeds.positions);
  }

  const BenchTask& task_;
  BenchRow& row_;
  std::optional<Diagram> diagram_;
};

}  // namespace

io::SeedTable white_seeds(const Domain& domain, std::size_t n) {
  const double spacing = std::pow(domain.measure() / static_cast<double>(n), 1.0 / domain.cell_dimension());
  return io::random_seeds({n, 0, spacing * spacing / 2, 1}, domain);
}

double time_once(Diagram& diagram, const io::SeedTable& seeds, bool adjacency) {
  const double built = diagram.device().build_seconds();
  Stopwatch watch;
  diagram.set_seeds(seeds.view());
  diagram.compute(adjacency, false);
  return watch.lap() - (diagram.device().build_seconds() - built);
}

std::size_t round_seeds(double wanted) {
  std::size_t best = least_seeds;
  for (std::size_t decade = least_seeds; decade <= most_seeds; decade *= 10)
    for (const std::size_t step : {1, 2, 5})
      if (decade * step <= most_seeds && static_cast<double>(decade * step) <= wanted) best = decade * step;
  return best;
}

std::string fault_of(const Measures& measures, Precision precision, const Measures* before) {
  const double allowed = partition_tolerance(precision);
  // Not-a-number is a fault too, hence the negated comparison.
  if (!(measures.relative_error() <= allowed))
    return fmt::format(
        "the measures sum to {:.17g}, the domain's is {:.17g} (relative error {:.1e}, allowed {:.0e})",
        measures.total(), measures.domain_measure, measures.relative_error(), allowed);
  if (before && (before->mass != measures.mass || before->second_moment != measures.second_moment))
    return "two runs on the same seeds gave different measures";
  return {};
}

BenchRow time_row(const BenchTask& task, WorkCounts& counts) {
  BenchRow row;
  row.domain = task.name;
  row.precision = precision_name(task.options.precision);
  row.n = task.n;
  row.regions = task.domain->domain.region_count();
  row.rates = task.rates;
  try {
    RowTimer(task, row).run(counts);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::interrupted) throw;
    row.failure = error.what();
  } catch (const std::bad_alloc&) {
    row.failure = "out of memory on the host; try fewer seeds with --n";
  }
  return row;
}

}  // namespace powercell::app
