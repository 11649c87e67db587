#include <powercell/c/verify.h>

#include <memory>
#include <powercell/verify.hpp>

#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

struct Checks {
  std::vector<LawCheck> laws;
  std::vector<pc_law_check> views;
  std::vector<const pc_law_check*> pointers;
};

pc_verify_options default_verify_options() {
  const VerifyOptions from;
  pc_verify_options to{};
  to.samples = from.samples;
  to.random_seed = from.random_seed;
  return to;
}

VerifyOptions verify_options(const pc_verify_options* options) {
  const pc_verify_options from = current(options, default_verify_options(), "pc_verify_options");
  VerifyOptions to;
  to.samples = from.samples;
  to.random_seed = from.random_seed;
  to.progress = progress_of(from.progress, from.progress_user);
  return to;
}

pc_saved_diagram empty_diagram() {
  pc_saved_diagram empty{};
  empty.precision = PC_FLOAT64;
  return empty;
}

Measures measures_of(const pc_saved_diagram& from) {
  Measures to;
  to.dimension = from.dimension;
  to.mass = vector_of(from.mass, from.count);
  if (from.centroid) to.centroid = vector_of(from.centroid, from.count * coordinates(from.dimension));
  for (const std::uint8_t status : view(from.status, from.count, "status")) {
    require(status <= PC_SEED_DUPLICATE, "a status is not a value of pc_seed_status");
    to.status.push_back(static_cast<SeedStatus>(status));
  }
  to.domain_measure = from.domain_measure;
  return to;
}

JoinedCells joined_of(const pc_saved_diagram& from) {
  JoinedCells to;
  to.dimension = from.dimension;
  to.cell_dimension = from.cell_dimension;
  to.vertex_offset = vector_of(from.vertex_offset, from.count + 1);
  to.vertices = vector_of(from.vertices, to.vertex_offset.back() * coordinates(from.dimension));
  to.face_offset = vector_of(from.face_offset, from.count + 1);
  const std::size_t faces = to.face_offset.back();
  to.loop_offset = vector_of(from.loop_offset, faces + 1);
  const std::size_t entries = to.loop_offset.back();
  to.loop = vector_of(from.loop, entries);
  if (from.face_border) to.face_border = borders_of(from.face_border, faces);
  if (from.edge_border) to.edge_border = borders_of(from.edge_border, entries);
  if (from.shift) to.shift = shifts_of(from.shift, to.face_border.size() + to.edge_border.size());
  return to;
}

void fill(pc_law_checks& to, Checks& from) {
  to.passed = 1;
  for (const LawCheck& law : from.laws) {
    from.views.push_back({law.law.c_str(), law.passed, law.value, law.tolerance, law.detail.c_str()});
    if (!law.passed) to.passed = 0;
  }
  from.pointers = pointers(from.views);
  to.count = from.pointers.size();
  to.checks = pointer(from.pointers);
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_verify_options_init(pc_verify_options* options, size_t struct_size) {
  return init(options, struct_size, default_verify_options(), "pc_verify_options");
}

pc_status pc_diagram_verify(pc_diagram* diagram, const double* positions, const double* weights, size_t count,
                            const pc_verify_options* options, const pc_law_checks** checks) {
  return guarded([&] {
    result_at(checks);
    Diagram& of = diagram_in(diagram);
    const VerifyOptions with = verify_options(options);
    const SeedsView seeds = seeds_of(of.domain().dimension(), positions, weights, count);
    hand_over_result(checks, Checks{verify(of, seeds, with), {}, {}}, fill);
  });
}

pc_status pc_saved_diagram_init(pc_saved_diagram* diagram, size_t struct_size) {
  return init(diagram, struct_size, empty_diagram(), "pc_saved_diagram");
}

pc_status pc_saved_diagram_verify(const pc_saved_diagram* diagram, const pc_verify_options* options,
                                  const pc_law_checks** checks) {
  return guarded([&] {
    result_at(checks);
    checked(diagram, "diagram");
    const pc_saved_diagram given = current(diagram, empty_diagram(), "pc_saved_diagram");
    coordinates(given.dimension);
    require(given.count <= most_seeds_of_diagram, "diagram.count is above PC_MOST_SEEDS");
    const Measures measures = measures_of(given);
    const JoinedCells cells = joined_of(given);
    const SavedDiagram saved{
        value_of<DomainKind>(given.kind, PC_VOLUME, "diagram.kind", "pc_domain_kind"),
        value_of<Precision>(given.precision, PC_FLOAT32, "diagram.precision", "pc_precision"),
        seeds_of(given.dimension, given.positions, given.weights, given.count), measures, cells};
    hand_over_result(checks, Checks{verify(saved, verify_options(options)), {}, {}}, fill);
  });
}

void pc_law_checks_destroy(const pc_law_checks* checks) {
  destroy_result<Checks>(checks);
}

}  // extern "C"
