#include "apps/io/write/transport.hpp"

#include <nlohmann/json.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/names.hpp"
#include "apps/io/tables/seed_rows.hpp"

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
  SeedRows rows(path, {seeds.dimension, seeds.positions, result.weights}, inputs,
                {"status", "target", "mass", "centroid", "second_moment", "merged_with"});
  const auto d = static_cast<std::size_t>(seeds.dimension);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    rows.begin(i);
    rows.fields().text(io::name(status_of(result, i)));
    rows.fields().number(result.target[i]);
    rows.fields().number(result.mass[i]);
    rows.point(&result.centroid[i * d]);
    rows.fields().number(result.second_moment[i]);
    if (result.merged_with[i] != i)
      rows.fields().count(result.merged_with[i]);
    else
      rows.fields().empty();
    rows.fields().end_row();
  }
  rows.commit();
}

void write_steps(const std::string& path, const TransportResult& result) {
  AtomicFile file(path);
  for (const TransportStep& step : result.steps) file.write(as_json(step).dump() + "\n");
  file.commit();
}

}  // namespace powercell::io
