#include "apps/tune/job.hpp"

#include "apps/bench/timing.hpp"

namespace powercell::app {
namespace {

class HostRun : public TunedRun {
 public:
  HostRun(const TuneJob& job, const Device& device, Options options)
      : job_(job), diagram_(device, job.domain, std::move(options)) {}

  double time() override {
    const double seconds = time_once(diagram_, job_.seeds, false);
    if (const std::string fault = fault_of(diagram_.measures(), job_.precision, nullptr); !fault.empty())
      throw Error(ErrorCode::internal, fault);
    return seconds;
  }

  std::vector<double> measures() const override {
    const Measures& measures = diagram_.measures();
    std::vector<double> all = measures.mass;
    for (const auto* more : {&measures.centroid, &measures.second_moment})
      all.insert(all.end(), more->begin(), more->end());
    return all;
  }

 private:
  const TuneJob& job_;
  mutable Diagram diagram_;
};

}  // namespace

std::unique_ptr<TunedRun> start(const TuneJob& job, const Device& device, Options options) {
  if (job.in_device_memory) return start_in_device_memory(job, device.info(), settings_of(device));
  options.precision = job.precision;
  return std::make_unique<HostRun>(job, device, std::move(options));
}

}  // namespace powercell::app
