#include "apps/bench/run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "apps/bench/table.hpp"
#include "apps/bench/timing.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/closest.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

// Seconds for all rows together, and for one run of one row. Rows on a slow device may take longer.
constexpr double usual_seconds = 75, quick_seconds = 10;
constexpr double usual_run = 1, quick_run = 0.05;

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
    record_.threads = arguments.threads;
    record_.cold = arguments.cold;
    record_.repeat = arguments.repeat;
    for (const DeviceInfo& device : find_devices(arguments)) record_.devices.push_back({device, {}});
  }

  BenchRecord run() {
    for (const BenchDevice& device : record_.devices)
      rows_left_ += precisions_of(arguments_, device.info).size() * domains_.size();
    rows_ = rows_left_;
    for (BenchDevice& device : record_.devices) run_device(device);
    progress_.finish();
    record_.seconds = spent();
    return std::move(record_);
  }

 private:
  void run_device(BenchDevice& measured_device) {
    const DeviceInfo& device = measured_device.info;
    say(fmt::format("{}  {} ({}, {}), {} units", device.selector(), device.name, device.platform_name,
                    device.driver_version, device.compute_units));
    measured_device.latencies = latencies_of(device);
    std::vector<std::pair<Precision, DeviceRates>> measured;
    std::vector<std::string> faults;
    for (const Precision precision : precisions_of(arguments_, device)) {
      std::string fault;
      measured.emplace_back(precision, rates_of(device, precision, fault));
      faults.push_back(fault);
    }
    say(table_head());
    for (const NamedDomain& domain : domains_)
      for (std::size_t k = 0; k < measured.size(); ++k)
        run_row(device, domain, measured[k].first, measured[k].second, faults[k]);
  }

  // A device that cannot be used fails its rows, which say why.
  DeviceLatencies latencies_of(const DeviceInfo& device) {
    DeviceLatencies latencies;
    try {
      const Device opened = open_device(on_device(arguments_, device.selector()));
      compute([&] { latencies = measure_device_latencies(opened); });
      say(fmt::format("     a launch takes {:.1f} us, a transfer {:.1f} us", 1e6 * latencies.launch,
                      1e6 * latencies.transfer));
    } catch (const Error& error) {
      if (error.code() == ErrorCode::interrupted) throw;
    }
    return latencies;
  }

  DeviceRates rates_of(const DeviceInfo& device, Precision precision, std::string& fault) {
    DeviceRates rates;
    try {
      const Device opened = open_device(on_device(arguments_, device.selector()));
      compute([&] { rates = measure_device_rates(opened, precision); });
      say(fmt::format("     {}: {:.1f} GB/s copied, {:.1f} Gflop/s multiplied and added",
                      precision_name(precision), 1e-9 * rates.copied_bytes, 1e-9 * rates.operations));
    } catch (const Error& error) {
      if (error.code() == ErrorCode::interrupted) throw;
      fault = error.what();
    }
    return rates;
  }

  void run_row(const DeviceInfo& device, const NamedDomain& domain, Precision precision,
               const DeviceRates& rates, const std::string& fault) {
    const CommonOptions options = on_device(arguments_, device.selector());
    BenchTask task{domain.name, &domain.loaded, [options] { return open_device(options); },
                   library_options(options)};
    task.options.precision = precision;
    task.n = seeds_of(device, domain.name, precision);
    if (domain.name == headline_domain)
      task.wanted = arguments_.quick ? quick_headline_seeds : headline_seeds;
    task.repeat = arguments_.repeat;
    task.seconds = std::max(1.0, (seconds_in_all() - spent()) / static_cast<double>(rows_left_--));
    task.longest = arguments_.quick ? quick_run : usual_run;
    task.rates = rates;
    follow(task);

    BenchRow row;
    row.domain = domain.name;
    row.precision = precision_name(precision);
    row.failure = fault;
    if (fault.empty()) compute([&] { row = time_row(task, counts_); });
    row.device = device.name;
    row.selector = device.selector();
    say(table_line(row));
    record_.rows.push_back(std::move(row));
  }

  // A row has many diagrams; how much of it is done shows in the time.
  void follow(BenchTask& task) {
    const double row = 1 / static_cast<double>(rows_),
                 done = row * static_cast<double>(rows_ - rows_left_ - 1);
    progress_.part(done, done + row);
    progress_.note(task.name + std::string(" in ") + precision_name(task.options.precision));
    task.options.progress = [this, watch = Stopwatch(), spent = 0.0, in_all = task.seconds](double) mutable {
      constexpr double most = 0.95;
      spent += watch.lap();
      return progress_.at(std::min(most, spent / in_all));
    };
  }

  // From the arguments, else from the earlier record, else 0 to choose by time.
  std::size_t seeds_of(const DeviceInfo& device, const std::string& domain, Precision precision) const {
    if (arguments_.n || !earlier_) return arguments_.n;
    const SavedRow* row =
        earlier_->find(device.name, device.selector(), domain, precision_name(precision), 0);
    return row ? row->n : 0;
  }

  double seconds_in_all() const { return arguments_.quick ? quick_seconds : usual_seconds; }

  double spent() {
    spent_ += watch_.lap();
    return spent_;
  }

  void say(const std::string& text) {
    if (!arguments_.talk()) return;
    progress_.aside([&] {
      fmt::print("{}\n", text);
      std::fflush(stdout);
    });
  }

  const BenchArguments& arguments_;
  const SavedRecord* earlier_;
  Progress progress_;
  std::vector<NamedDomain> domains_;
  WorkCounts counts_;
  BenchRecord record_;
  std::size_t rows_ = 0, rows_left_ = 0;
  Stopwatch watch_;
  double spent_ = 0;
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
