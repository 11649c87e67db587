#include "apps/sampling/study.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/common.hpp"
#include "apps/interrupt.hpp"
#include "apps/sampling/progress.hpp"

namespace powercell::app {
namespace {

/// In units of sqrt(n). There is no agreed limit of low frequencies, and the power rises steeply there.
constexpr std::array<double, 5> cutoffs{0.3, 0.4, 0.44, 0.5, 0.6};

/// Of all threads, without compiling kernels.
double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime) - kernel_builds().processor_seconds;
}

/// JSON has no NaN.
nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json as_json(const Run& run) {
  nlohmann::json steps = nlohmann::json::array();
  for (const SamplingStep& step : run.points.steps)
    steps.push_back({{"iteration", step.iteration},
                     {"energy", step.energy},
                     {"gradient", step.gradient},
                     {"hexatic", number(step.hexatic)},
                     {"capacity_error", step.capacity_error},
                     {"newton_steps", step.newton_steps},
                     {"seconds", step.seconds}});
  return {{"converged", run.points.converged},
          {"iterations", run.points.steps.back().iteration},
          {"capacity_error", run.points.capacity_error},
          {"quadrature_error", run.points.quadrature_error},
          {"energy", run.points.energy},
          {"relative_energy", run.points.relative_energy},
          {"apart",
           {{"cells", run.points.apart.cells},
            {"share", run.points.apart.share},
            {"distance", run.points.apart.distance}}},
          {"layers", run.points.layers},
          {"least_distance", number(run.spacing.least)},
          {"mean_distance", number(run.spacing.mean)},
          {"hexatic", number(run.spacing.hexatic)},
          {"seconds", run.seconds},
          {"processor_seconds", run.processor_seconds},
          {"steps", steps}};
}

template <class Value>
double mean_of(const Study& study, const Value& value) {
  double sum = 0;
  for (const Run& run : study.runs) sum += value(run);
  return sum / static_cast<double>(study.runs.size());
}

Spacing spacing_of(const Device& device, const Source& source, const SamplingResult& points,
                   const SamplingOptions& options) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (points.weights.size() == 1) return {nan, nan, nan};
  if (!points.layers.empty()) return points.layer_spacing;
  return spacing(device, source.domain, points.positions, options.periodic, source.density.is_constant(),
                 options.diagram);
}

}  // namespace

Study run_study(const Device& device, const Source& source, std::size_t n, const SamplingOptions& options,
                int runs, bool spectra, Progress& progress) {
  Study study;
  std::vector<Spectrum> found;
  for (int k = 0; k < runs; ++k) {
    SamplingOptions own = options;
    own.random_seed += static_cast<std::uint64_t>(k);
    own.progress = sampling_progress(progress, own, source.domain, n);
    progress.part(static_cast<double>(k) / runs, (k + 1.0) / runs);
    Run run;
    compute([&] {
      const double before = progress.seconds(sampling_stage), processor_before = processor_seconds();
      run.points = sample(device, source.domain, n, own);
      run.seconds = progress.seconds(sampling_stage) - before;
      run.processor_seconds = processor_seconds() - processor_before;
      run.spacing = spacing_of(device, source, run.points, own);
      if (spectra) found.push_back(spectrum(source.domain, run.points.positions, 0, own.diagram.threads));
    });
    study.runs.push_back(std::move(run));
  }
  if (!found.empty()) study.spectrum = mean(found);
  return study;
}

nlohmann::json as_json(const Study& study, bool with_power) {
  nlohmann::json json;
  for (const Run& run : study.runs) json["runs"].push_back(as_json(run));
  const auto mean = [&](const auto& value) { return number(mean_of(study, value)); };
  json["mean"] = {{"capacity_error", mean([](const Run& r) { return r.points.capacity_error; })},
                  {"relative_energy", mean([](const Run& r) { return r.points.relative_energy; })},
                  {"least_distance", mean([](const Run& r) { return r.spacing.least; })},
                  {"mean_distance", mean([](const Run& r) { return r.spacing.mean; })},
                  {"hexatic", mean([](const Run& r) { return r.spacing.hexatic; })},
                  {"iterations", mean([](const Run& r) { return double(r.points.steps.back().iteration); })},
                  {"seconds", mean([](const Run& r) { return r.seconds; })},
                  {"processor_seconds", mean([](const Run& r) { return r.processor_seconds; })}};
  if (study.spectrum) {
    const Spectrum::Radial radial = study.spectrum->radial();
    std::vector<double> decibels;
    for (const double a : radial.anisotropy) decibels.push_back(a > 0 ? 10 * std::log10(a) : -100);
    json["spectrum"] = {
        {"points", study.spectrum->points},   {"runs", study.spectrum->runs},
        {"highest", study.spectrum->highest}, {"radial_mean", radial.mean},
        {"anisotropy_db", decibels},          {"low_frequency", study.spectrum->low_frequency()}};
    for (const double cutoff : cutoffs)
      json["spectrum"]["low_frequencies"].push_back(
          {{"cutoff", cutoff}, {"power", study.spectrum->low_frequency(cutoff)}});
    if (with_power) json["spectrum"]["power"] = study.spectrum->power;
  }
  return json;
}

std::string line_of(const Run& run) {
  const SamplingResult& points = run.points;
  std::string text = fmt::format(
      "{} point{}, {} iterations, capacity error {:.1e}, energy {:.6g} ({:.4f} of the lattice)",
      with_commas(points.weights.size()), points.weights.size() == 1 ? "" : "s",
      points.steps.back().iteration, points.capacity_error, points.energy, points.relative_energy);
  if (std::isfinite(run.spacing.least))
    text += fmt::format(", distances{} least {:.3f} mean {:.3f}", points.layers.empty() ? "" : " on layers",
                        run.spacing.least, run.spacing.mean);
  if (std::isfinite(run.spacing.hexatic)) text += fmt::format(", hexatic order {:.3f}", run.spacing.hexatic);
  return text + fmt::format("; {:.2f} s ({:.2f} s of processors)", run.seconds, run.processor_seconds);
}

std::string summary_of(const Study& study) {
  std::string text = fmt::format("mean of {}: energy {:.4f} of the lattice", study.runs.size(),
                                 mean_of(study, [](const Run& r) { return r.points.relative_energy; }));
  const double least = mean_of(study, [](const Run& r) { return r.spacing.least; });
  if (std::isfinite(least))
    text += fmt::format(", distances least {:.3f} mean {:.3f}", least,
                        mean_of(study, [](const Run& r) { return r.spacing.mean; }));
  const double order = mean_of(study, [](const Run& r) { return r.spacing.hexatic; });
  if (std::isfinite(order)) text += fmt::format(", hexatic order {:.3f}", order);
  if (study.spectrum) text += fmt::format(", low-frequency power {:.2e}", study.spectrum->low_frequency());
  return text;
}

}  // namespace powercell::app
