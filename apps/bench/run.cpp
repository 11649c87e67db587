#include "apps/bench/run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>

#include "apps/bench/sizes.hpp"
#include "apps/bench/table.hpp"
#include "apps/bench/timing.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/closest.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

// Seconds for the runs of all rows of a device together. Rows whose runs settle need less.
constexpr double usual_seconds = 75, quick_seconds = 20;

// The default domains; the meshes have about 5,000 triangles and 14,000 tetrahedra.
struct Shape {
  const char *name, *spec;
};
constexpr Shape shapes[] = {
    {"square", "square"}, {"cube", "cube"}, {"surface", "sphere:16"}, {"volume", "ball:12"}};

struct NamedDomain {
  std::string name;
  io::LoadedDomain loaded;
};

NamedDomain load(const std::string& name) {
  for (const Shape& shape : shapes)
    if (name == shape.name) return {name, io::read_domain(shape.spec)};
  if (!io::is_builtin_domain(name) && !std::filesystem::exists(name))
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format(
            "unknown domain '{}'; --domain takes square, cube, surface, volume, or a file or shape as for "
            "'powercell diagram --domain'{}",
            name, io::did_you_mean(io::closest(name, bench_domain_names()))));
  return {name, io::read_domain(name)};
}

std::vector<NamedDomain> load_domains(const BenchArguments& arguments) {
  std::vector<NamedDomain> domains;
  for (const std::string& name : arguments.domains) domains.push_back(load(name));
  if (domains.empty())
    for (const Shape& shape : shapes) domains.push_back(load(shape.name));
  return domains;
}

CommonOptions on_device(const BenchArguments& arguments, const std::string& selector) {
  CommonOptions options = arguments;
  options.device = selector;
  return options;
}

// Each device of a group is measured alone.
void add_members(const Device& device, std::vector<DeviceInfo>& found) {
  for (const Device& member : device.members()) found.push_back(member.info());
}

// The devices of --device, else those of POWERCELL_DEVICE, else all.
std::vector<DeviceInfo> find_devices(const BenchArguments& arguments) {
  std::vector<DeviceInfo> found;
  for (const std::string& selector : arguments.devices)
    add_members(open_device(on_device(arguments, selector)), found);
  if (!found.empty()) return found;
  const char* named = std::getenv("POWERCELL_DEVICE");
  if (named && *named) {
    add_members(open_device(arguments), found);
    return found;
  }
  limit_threads(arguments);
  found = devices();
  if (found.empty()) open_device(arguments);  // throws an error with advice
  return found;
}

std::vector<Precision> precisions_of(const BenchArguments& arguments, const DeviceInfo& device) {
  if (arguments.precision == "double") return {Precision::float64};
  if (arguments.precision == "float") return {Precision::float32};
  if (!device.fp64) return {Precision::float32};
  return {Precision::float64, Precision::float32};
}

std::string now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

// One benchmark of all devices, precisions and domains.
class Bench {
 public:
  Bench(const BenchArguments& arguments, const SavedRecord* earlier)
      : arguments_(arguments),
        earlier_(earlier),
        progress_({{"measuring", 1}}, !arguments.talk()),
        domains_(load_domains(arguments)) {
    record_.revision = POWERCELL_REVISION;
    record_.date = now();
    record_.description = arguments.description;
    record_.host = host_info();
    record_.before = host_state();
    record_.threads = arguments.threads;
    record_.cold = arguments.cold;
    record_.repeat = arguments.repeat;
    for (const DeviceInfo& device : find_devices(arguments)) record_.devices.push_back({device});
  }

  BenchRecord run() {
    for (const BenchDevice& device : record_.devices)
      for (const RowPlan& plan : rows_of(device.info)) rows_ += plan.sizes.size();
    for (BenchDevice& device : record_.devices) run_device(device);
    progress_.finish();
    record_.after = host_state();
    record_.others = used_by_others(record_.before, record_.after);
    record_.seconds = watch_.lap();
    return std::move(record_);
  }

 private:
  // The rows of a domain and a precision.
  struct RowPlan {
    const NamedDomain* domain;
    Precision precision;
    std::vector<std::size_t> sizes;
  };

  std::vector<RowPlan> rows_of(const DeviceInfo& device) const {
    std::vector<RowPlan> plans;
    for (const NamedDomain& domain : domains_)
      for (const Precision precision : precisions_of(arguments_, device))
        plans.push_back({&domain, precision, sizes_of(device, domain.name, precision)});
    return plans;
  }

  // Of the arguments, else of the earlier record, else those that every record has.
  std::vector<std::size_t> sizes_of(const DeviceInfo& device, const std::string& domain,
                                    Precision precision) const {
    if (arguments_.n) return {arguments_.n};
    if (earlier_) {
      std::vector<std::size_t> sizes =
          earlier_->sizes(device.name, device.selector(), domain, precision_name(precision));
      if (!sizes.empty()) return sizes;
    }
    return row_sizes(domain, arguments_.quick);
  }

  void run_device(BenchDevice& measured) {
    const DeviceInfo& device = measured.info;
    say(fmt::format("{}  {} ({}, {}), {} units\n", device.selector(), device.name, device.platform_name,
                    device.driver_version, device.compute_units));
    progress_.note("rates of the device");
    std::map<Precision, std::string> faults;
    measure_calls(measured);
    for (const Precision precision : precisions_of(arguments_, device))
      faults[precision] = measure_rates(measured, precision);
    say(device_lines(measured) + table_head() + "\n");
    const std::vector<RowPlan> plans = rows_of(device);
    double shares = 0;
    for (const RowPlan& plan : plans)
      for (const std::size_t n : plan.sizes) shares += share_of_time(n);
    const double seconds = (arguments_.quick ? quick_seconds : usual_seconds) / shares;
    for (const RowPlan& plan : plans) run_rows(measured, plan, faults[plan.precision], seconds);
  }

  // Latencies and transfers. A device that cannot be used fails its rows, which say why.
  void measure_calls(BenchDevice& measured) {
    attempt([&] {
      const Device opened = open_device(on_device(arguments_, measured.info.selector()));
      compute([&] {
        measured.latencies = measure_device_latencies(opened);
        for (const std::size_t bytes : transfer_sizes())
          if (bytes <= measured.info.largest_allocation)
            measured.transfers.push_back({bytes, measure_device_transfers(opened, bytes)});
      });
    });
  }

  // The fault, if they cannot be measured.
  std::string measure_rates(BenchDevice& measured, Precision precision) {
    return attempt([&] {
      const Device opened = open_device(on_device(arguments_, measured.info.selector()));
      DeviceRates rates;
      compute([&] { rates = measure_device_rates(opened, precision); });
      measured.rates.push_back({precision_name(precision), rates});
    });
  }

  template <class Call>
  static std::string attempt(const Call& call) {
    try {
      call();
    } catch (const Error& error) {
      if (error.code() == ErrorCode::interrupted) throw;
      return error.what();
    } catch (const std::bad_alloc&) {
      return "out of memory on the host";
    }
    return {};
  }

  // In ascending numbers of seeds: the rate with fewer tells how long a run with more takes.
  void run_rows(const BenchDevice& measured, const RowPlan& plan, const std::string& fault,
                double seconds_of_share) {
    double rate = 0;
    for (const std::size_t n : plan.sizes) {
      const DeviceInfo& device = measured.info;
      const std::string& domain = plan.domain->name;
      const std::string precision = precision_name(plan.precision);
      std::string reason;
      if (plan.sizes.size() > 1) reason = why_left_out(n, device.memory_bytes, rate);
      if (!reason.empty()) {
        record_.left_out.push_back({device.name, device.selector(), domain, precision, n, reason});
        say(table_line(record_.left_out.back()) + "\n");
        ++rows_done_;
        continue;
      }
      BenchTask task = task_of(measured, plan, n, seconds_of_share * share_of_time(n));
      BenchRow row;
      row.domain = domain;
      row.precision = precision;
      row.n = n;
      row.failure = fault;
      if (fault.empty()) compute([&] { row = time_row(task, counts_); });
      row.device = device.name;
      row.selector = device.selector();
      rate = row.rate();
      say(table_line(row) + "\n");
      record_.rows.push_back(std::move(row));
      ++rows_done_;
    }
  }

  BenchTask task_of(const BenchDevice& measured, const RowPlan& plan, std::size_t n, double seconds) {
    const CommonOptions options = on_device(arguments_, measured.info.selector());
    BenchTask task{plan.domain->name, &plan.domain->loaded, [options] { return open_device(options); },
                   library_options(options), n};
    task.options.precision = plan.precision;
    task.limits = {arguments_.repeat, seconds / 2};
    for (const BenchRates& rates : measured.rates)
      if (rates.precision == precision_name(plan.precision)) task.rates = rates.rates;
    follow(task, seconds);
    return task;
  }

  // A row has many diagrams; how much of it is done shows in the time.
  void follow(BenchTask& task, double seconds) {
    const double row = 1 / static_cast<double>(rows_), done = row * static_cast<double>(rows_done_);
    progress_.part(done, done + row);
    progress_.note(
        fmt::format("{}, {}, {}", task.name, precision_name(task.options.precision), with_commas(task.n)));
    task.options.progress = [this, watch = Stopwatch(), spent = 0.0, seconds](double) mutable {
      constexpr double most = 0.95;
      spent += watch.lap();
      return progress_.at(std::min(most, spent / seconds));
    };
  }

  void say(const std::string& text) {
    if (!arguments_.talk()) return;
    progress_.aside([&] {
      fmt::print("{}", text);
      std::fflush(stdout);
    });
  }

  const BenchArguments& arguments_;
  const SavedRecord* earlier_;
  Progress progress_;
  std::vector<NamedDomain> domains_;
  WorkCounts counts_;
  BenchRecord record_;
  std::size_t rows_ = 0, rows_done_ = 0;
  Stopwatch watch_;
};

}  // namespace

std::vector<std::string> bench_domain_names() {
  std::vector<std::string> names = io::builtin_domain_names();
  for (const Shape& shape : shapes)
    if (std::find(names.begin(), names.end(), shape.name) == names.end()) names.emplace_back(shape.name);
  return names;
}

BenchRecord run_bench(const BenchArguments& arguments, const SavedRecord* earlier) {
  return Bench(arguments, earlier).run();
}

}  // namespace powercell::app
