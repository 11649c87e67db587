#include "lib/domain/adjacency.hpp"

namespace powercell {

void number_boundary(RegionMesh& mesh) {
  for (Border& border : mesh.facet) {
    if (border.kind == Border::Kind::boundary) border.index = mesh.boundary_count++;
  }
}

}  // namespace powercell
