#include <cmath>

#include "lib/base/text.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/measure.hpp"

namespace powercell {
namespace {

void check_corners(std::span<const double> low, std::span<const double> high) {
  if (low.size() != high.size() || (low.size() != 2 && low.size() != 3)) {
    throw Error(ErrorCode::invalid_domain, "a box needs 2 or 3 coordinates for each corner, got " +
                                               std::to_string(low.size()) + " and " +
                                               std::to_string(high.size()));
  }
  for (std::size_t k = 0; k < low.size(); ++k) {
    const std::string axis = std::string("box, axis ") + "xyz"[k];
    if (!std::isfinite(low[k]) || !std::isfinite(high[k])) {
      throw Error(ErrorCode::invalid_domain, axis + ": a corner is not finite");
    }
    if (!(low[k] < high[k])) {
      throw Error(ErrorCode::invalid_domain,
                  axis + ": low " + digits(low[k]) + " is not less than high " + digits(high[k]));
    }
  }
}

/// Makes the mesh one region whose facets all bound the domain, numbered in order.
void close_single_region(RegionMesh& mesh, std::uint32_t facets) {
  const auto corners = static_cast<std::uint32_t>(mesh.vertices.size()) / mesh.dimension;
  mesh.region_offset = {0, corners};
  for (std::uint32_t v = 0; v < corners; ++v) mesh.region_vertex.push_back(v);
  mesh.facet_offset = {0, facets};
  for (std::uint32_t f = 0; f < facets; ++f) mesh.facet.push_back({Border::Kind::boundary, f});
  mesh.boundary_count = facets;
  mesh.source = {0};
}

}  // namespace

RegionMeshPtr build_box(std::span<const double> low, std::span<const double> high) {
  check_corners(low, high);
  auto mesh = std::make_shared<RegionMesh>();
  long double measure = 1;
  for (std::size_t k = 0; k < low.size(); ++k) measure *= static_cast<long double>(high[k]) - low[k];

  mesh->dimension = mesh->cell_dimension = static_cast<int>(low.size());
  if (low.size() == 2) {
    mesh->kind = DomainKind::polygon;
    mesh->shape = RegionShape::polygon;
    mesh->vertices = {low[0], low[1], high[0], low[1], high[0], high[1], low[0], high[1]};
    close_single_region(*mesh, 4);
  } else {
    mesh->kind = DomainKind::volume;
    mesh->shape = RegionShape::box;
    for (int corner = 0; corner < 8; ++corner) {
      for (int k = 0; k < 3; ++k) mesh->vertices.push_back(((corner >> k) & 1 ? high : low)[k]);
    }
    close_single_region(*mesh, 6);
  }
  CompensatedSum<long double> sum;
  sum.add(measure);
  finish(*mesh, sum);
  return mesh;
}

}  // namespace powercell
