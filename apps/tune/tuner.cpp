#include "apps/tune/tuner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "apps/bench/timing.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/progress.hpp"
#include "apps/tune/job.hpp"
#include "apps/tune/settings.hpp"

namespace powercell::app {
namespace {

constexpr double usual_run = 0.2;                                          // seconds of one run, at least
constexpr std::size_t first_seeds = 10'000, most_tuned_seeds = 1'000'000;  // of the diagrams side by side
constexpr double bytes_a_seed = 20'000;                                    // upper estimate for all of these

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class Tuner {
 public:
  Tuner(const TuneArguments& arguments, const std::function<void(const TuneStep&)>& said)
      : arguments_(arguments), said_(said), progress_({{"measuring", 1}}, arguments.silent()) {
    const Device device = open_single_device(arguments);
    record_.device = device.info();
    record_.defaults = default_settings(record_.device);
    // What is not measured stays as it was.
    record_.before = record_.chosen = arguments.only.empty() ? record_.defaults : settings_of(device);
  }

  TuneRecord run() {
    add_jobs();
    const double steps = static_cast<double>(wanted().size()) + 1;
    for (const Setting& one : wanted()) {
      const double done = static_cast<double>(record_.steps.size());
      progress_.part(done / steps, (done + 1) / steps);
      tune_one(one);
    }
    progress_.part(1 - 1 / steps, 1);
    if (record_.chosen != record_.before) confirm();
    progress_.finish();
    return std::move(record_);
  }

 private:
  std::vector<Setting> wanted() const {
    std::vector<Setting> found;
    for (const Setting& one : all_settings())
      if (arguments_.only.empty() ||
          std::find(arguments_.only.begin(), arguments_.only.end(), one.name) != arguments_.only.end())
        found.push_back(one);
    return found;
  }

  static bool concerns(const Setting& one, const TuneJob& job) {
    const UsedBy other = job.in_device_memory ? UsedBy::diagram : UsedBy::device_diagram;
    return one.used_by != other && (one.cell_dimension == 0 || one.cell_dimension == job.cell_dimension());
  }

  // Those that some setting concerns.
  void add_jobs() {
    const std::vector<Setting> settings = wanted();
    for (const bool in_device_memory : {false, true})
      for (const char* shape : {"square", "cube"})
        for (const Precision precision : {Precision::float64, Precision::float32}) {
          if (precision == Precision::float64 && !record_.device.fp64) continue;
          TuneJob job{fmt::format("{} in {}{}", shape, precision_name(precision),
                                  in_device_memory ? " on the device" : ""),
                      io::read_domain(shape).domain, precision, in_device_memory};
          const auto concerned = [&](const Setting& one) { return concerns(one, job); };
          if (std::any_of(settings.begin(), settings.end(), concerned)) jobs_.push_back(std::move(job));
        }
  }

  // A device of its own for each value, since kernels keep what they were built with.
  Device open(const DeviceSettings& settings) const {
    Device device = open_device(arguments_);
    use_settings(device, settings);
    return device;
  }

  // With a new number of seeds until runs are long enough to compare.
  void choose_seeds(TuneJob& job, const Device& device) {
    if (!job.seeds.weights.empty()) return;
    const std::size_t most = std::min(
        most_tuned_seeds, round_seeds(static_cast<double>(record_.device.memory_bytes) / bytes_a_seed));
    std::size_t n = arguments_.n ? arguments_.n : std::min(first_seeds, most);
    job.seeds = white_seeds(job.domain, n);
    while (!arguments_.n && n < most) {
      const auto run = start(job, device, library_options(arguments_));
      run->time();
      const double seconds = run->time();
      if (seconds >= usual_run / 2) return;
      n = std::min(most, round_seeds(static_cast<double>(n) * std::clamp(usual_run / seconds, 2.0, 16.0)));
      job.seeds = white_seeds(job.domain, n);
    }
  }

  void tune_one(const Setting& one) {
    const std::uint64_t now = one.get(record_.chosen);
    std::vector<std::uint64_t> values = one.values(now);
    values.insert(values.begin(), now);
    std::vector<DeviceSettings> settings(values.size(), record_.chosen);
    for (std::size_t k = 0; k < values.size(); ++k) one.set(settings[k], values[k]);
    std::vector<TuneJob*> jobs;
    for (TuneJob& job : jobs_)
      if (concerns(one, job)) jobs.push_back(&job);
    TuneStep step = measure(one.name, values, settings, jobs);
    step.chosen = best_trial(step.trials);
    record_.chosen = settings[step.chosen];
    finish(std::move(step));
  }

  // The best of several runs of several values is lucky now and then, so the result has to win once more.
  void confirm() {
    std::vector<TuneJob*> jobs;
    for (TuneJob& job : jobs_) jobs.push_back(&job);
    TuneStep step = measure("all", {0, 1}, {record_.before, record_.chosen}, jobs);
    step.chosen = best_trial(step.trials);
    if (step.chosen == 0) record_.chosen = record_.before;
    finish(std::move(step));
  }

  void finish(TuneStep step) {
    progress_.aside([&] { said_(step); });
    record_.steps.push_back(std::move(step));
  }

  TuneStep measure(const std::string& name, const std::vector<std::uint64_t>& values,
                   const std::vector<DeviceSettings>& settings, const std::vector<TuneJob*>& jobs) {
    TuneStep step{name, {}, {}, {}};
    for (const std::uint64_t value : values) step.trials.push_back({value, {}, {}});
    std::vector<Device> devices;
    for (const DeviceSettings& one : settings) devices.push_back(open(one));
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      progress_.note(fmt::format("{}, {}", name, jobs[j]->name));
      choose_seeds(*jobs[j], devices[0]);
      step.jobs.push_back(jobs[j]->name);
      step.seeds.push_back(jobs[j]->seeds.weights.size());
      measure_job(step, devices, *jobs[j]);
      progress_.at(static_cast<double>(j + 1) / static_cast<double>(jobs.size()));
      stop_if_interrupted();
    }
    return step;
  }

  // All values are open side by side and run in turn, so that a machine that slows down slows all of them.
  void measure_job(TuneStep& step, const std::vector<Device>& devices, const TuneJob& job) {
    std::vector<std::unique_ptr<TunedRun>> runs(devices.size());
    std::vector<double> expected;
    for (std::size_t k = 0; k < devices.size(); ++k) {
      Trial& trial = step.trials[k];
      trial.runs.emplace_back();
      if (trial.failure.empty()) runs[k] = warmed_up(trial, job, devices[k], k > 0);
      if (!runs[k]) continue;
      if (k == 0) expected = runs[0]->measures();
      if (!same_bits(runs[k]->measures(), expected))
        throw Error(ErrorCode::internal,
                    fmt::format("{} = {} gives other measures than {} ({}), which it must not; "
                                "please report, with 'powercell devices --json'",
                                step.setting, trial.value, step.trials[0].value, job.name));
    }
    for (std::size_t turn = 0; turn < arguments_.repeat; ++turn)
      for (std::size_t k = 0; k < runs.size(); ++k) {
        stop_if_interrupted();
        if (runs[k]) step.trials[k].runs.back().seconds.push_back(runs[k]->time());
      }
  }

  // Builds the kernels. A value that the device cannot run is no choice; the one in use has to run.
  std::unique_ptr<TunedRun> warmed_up(Trial& trial, const TuneJob& job, const Device& device, bool may_fail) {
    try {
      auto run = start(job, device, library_options(arguments_));
      run->time();
      return run;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::interrupted || !may_fail) throw;
      trial.failure = error.what();
      return nullptr;
    }
  }

  const TuneArguments& arguments_;
  const std::function<void(const TuneStep&)>& said_;
  Progress progress_;
  TuneRecord record_;
  std::vector<TuneJob> jobs_;
};

}  // namespace

TuneRecord tune(const TuneArguments& arguments, const std::function<void(const TuneStep&)>& said) {
  const char* lanes = std::getenv("POWERCELL_LANES");
  if (lanes && *lanes)
    throw Error(
        ErrorCode::invalid_argument,
        "the environment variable POWERCELL_LANES overrules the lanes that are to be measured; unset it");
  TuneRecord record;
  compute([&] { record = Tuner(arguments, said).run(); });
  return record;
}

}  // namespace powercell::app
