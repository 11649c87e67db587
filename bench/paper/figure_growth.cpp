#include "bench/paper/figures.hpp"
#include "bench/workload.hpp"

namespace powercell::paper {

namespace {

void growth(const Study& study, const std::string& name, const Domain& domain,
            const std::vector<std::size_t>& sizes) {
  TableFile file(
      study, name,
      "seeds uniform in measure, weights uniform in [0, range h^2]; microseconds of processor time a "
      "seed, wall seconds of all; pairs are (region, seed)",
      {"n", "range", "hidden", "pairs", "flann_us", "tree_us", "flann_s", "tree_s"});
  for (const double range : {0.0, 0.5, 4.0}) {
    Trial trial(study.device, domain, {tree_way(), list_way()});
    for (const std::size_t n : sizes) {
      const test::SeedArray seeds = white_seeds(domain, n, range);
      const std::vector<Time> times = trial.run(seeds.view(), n < 30000 ? 3 : 2);
      file.row({std::uint64_t{n}, range, mean(trial.hidden(), n), times[0].timings.pair_count,
                per_seed(times[1].processor, n), per_seed(times[0].processor, n), times[1].wall,
                times[0].wall});
    }
  }
}

}  // namespace

void surface_figure(const Study& study) {
  growth(study, "figure9", bench::domain_of("surface"),
         study.quick ? std::vector<std::size_t>{1000, 3000, 10000}
                     : std::vector<std::size_t>{1000, 2000, 5000, 10000, 30000, 100000, 300000});
}

void volume_figure(const Study& study) {
  growth(study, "figure10", bench::domain_of("tets"),
         study.quick ? std::vector<std::size_t>{1000, 3000}
                     : std::vector<std::size_t>{1000, 2000, 5000, 10000, 30000, 100000});
}

}  // namespace powercell::paper
