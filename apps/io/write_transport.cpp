#include "apps/io/write_transport.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/names.hpp"
#include "apps/io/write_table.hpp"

namespace powercell::io {
namespace {

SeedStatus status_of(const TransportResult& result, std::size_t i) {
  if (result.merged_with[i] != i) return SeedStatus::duplicate;
  return result.mass[i] > 0 ? SeedStatus::ok : SeedStatus::hidden;
}

nlohmann::ordered_json as_json(const TransportStep& step) {
  return {{"step", step.step},
          {"phase", name(step.phase)},
          {"exponent", step.exponent},
          {"spread", step.spread},
          {"error", step.error},
          {"gradient", step.gradient},
          {"least", step.least},
          {"empty", step.empty},
          {"dual", step.dual},
          {"length", step.length},
          {"diagrams", step.diagrams},
          {"linear", name(step.linear)},
          {"linear_iterations", step.linear_iterations},
          {"linear_residual", step.linear_residual},
          {"diagram_seconds", step.diagram_seconds},
          {"linear_seconds", step.linear_seconds}};
}

}  // namespace

void write_transport_table(const std::string& path, const SeedsView& seeds, const TransportResult& result,
                           const InputView& inputs) {
  AtomicFile file(path);
  const double* positions = inputs.positions(seeds);
  file.write(seeds.dimension == 3
                 ? "seed,x,y,z,weight,status,target,mass,cx,cy,cz,second_moment,merged_with\n"
                 : "seed,x,y,weight,status,target,mass,cx,cy,second_moment,merged_with\n");
  const auto d = static_cast<std::size_t>(seeds.dimension);
  const auto number = [&file](double value) {
    file.write(',');
    if (std::isfinite(value)) file.number(value);
  };
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    file.number(std::uint64_t{i});
    write_point_fields(file, positions + i * d, d, nullptr);
    number(result.weights[i]);
    file.write(',');
    file.write(io::name(status_of(result, i)));
    number(result.target[i]);
    number(result.mass[i]);
    write_point_fields(file, &result.centroid[i * d], d, inputs.plane());
    number(result.second_moment[i]);
    file.write(',');
    if (result.merged_with[i] != i) file.number(std::uint64_t{result.merged_with[i]});
    file.write('\n');
  }
  file.commit();
}

void write_steps(const std::string& path, const TransportResult& result) {
  AtomicFile file(path);
  for (const TransportStep& step : result.steps) file.write(as_json(step).dump() + "\n");
  file.commit();
}

}  // namespace powercell::io
