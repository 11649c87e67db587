#include "lib/scene/variant.hpp"

namespace powercell {

std::vector<std::string> Variant::defines() const {
  return {std::string("REAL_BITS=") + (float32 ? "32" : "64"),
          "DIMENSION=" + std::to_string(dimension),
          "CELL_DIMENSION=" + std::to_string(cell_dimension),
          "VERTEX_CAPACITY=" + std::to_string(capacity.vertices),
          "FACE_CAPACITY=" + std::to_string(capacity.faces),
          "LANE_WIDTH=" + std::to_string(lane_width)};
}

const std::vector<Capacity>& capacities(int cell_dimension) {
  // Vertices come in blocks of eight. A polygon has as many edges as vertices; a simple polyhedron of F faces
  // has 2F - 4 vertices, but needs more while it is cut.
  static const std::vector<Capacity> polygons = {{16, 16}, {128, 128}};
  static const std::vector<Capacity> polyhedra = {{64, 48}, {248, 128}};
  return cell_dimension == 2 ? polygons : polyhedra;
}

std::vector<Variant> all_variants(bool float32, int lane_width) {
  const int spaces[3][2] = {{2, 2}, {3, 2}, {3, 3}};
  std::vector<Variant> all;
  for (const auto& [dimension, cell_dimension] : spaces)
    for (const Capacity& capacity : capacities(cell_dimension))
      all.push_back({dimension, cell_dimension, float32, capacity, lane_width});
  return all;
}

}  // namespace powercell
