#include "lib/c_api/handles.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

/// The cells that a struct of C points to.
Cells copied(const pc_cells& from) {
  Cells to;
  to.dimension = from.dimension;
  to.cell_dimension = from.cell_dimension;
  to.cell_offset = vector_of(from.cell_offset, from.count + 1);
  to.region = vector_of(from.region, from.piece_count);
  to.vertex_offset = vector_of(from.vertex_offset, from.piece_count + 1);
  to.vertices = vector_of(from.vertices, from.vertex_count * coordinates(from.dimension));
  to.face_offset = vector_of(from.face_offset, from.piece_count + 1);
  to.border = borders_of(from.border, from.face_count);
  if (from.shift) to.shift = shifts_of(from.shift, from.face_count);
  if (from.loop_offset) {
    to.loop_offset = vector_of(from.loop_offset, from.face_count + 1);
    to.loop = vector_of(from.loop, to.loop_offset.back());
  }
  return to;
}

}  // namespace
}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_join(const pc_domain* domain, const pc_cells* cells, const pc_joined** joined) {
  return guarded([&] {
    result_at(joined);
    const pc_cells& of = checked(cells, "cells");
    hand_over_result(joined, join(domain_in(domain), copied(of)),
                     [](pc_joined& to, const JoinedCells& from) { to.cells = view_of(from); });
  });
}

void pc_joined_destroy(const pc_joined* joined) {
  destroy_result<JoinedCells>(joined);
}

}  // extern "C"
