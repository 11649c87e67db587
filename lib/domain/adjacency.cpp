#include "lib/domain/adjacency.hpp"

namespace powercell {

std::vector<std::array<std::uint32_t, 2>> distinct(std::vector<std::array<std::uint32_t, 2>> repeated) {
  std::sort(repeated.begin(), repeated.end());
  repeated.erase(std::unique(repeated.begin(), repeated.end()), repeated.end());
  return repeated;
}

void number_boundary(RegionMesh& mesh) {
  for (Border& border : mesh.facet) {
    if (border.kind == Border::Kind::boundary) border.index = mesh.boundary_count++;
  }
}

}  // namespace powercell
