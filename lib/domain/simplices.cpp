#include <array>
#include <cmath>

#include "lib/base/mesh_arrays.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/measure.hpp"

namespace powercell {

std::shared_ptr<RegionMesh> simplex_mesh(std::span<const double> vertices,
                                         std::span<const std::uint32_t> simplices, int corners,
                                         long double (*signed_measure)(const double* const* corner),
                                         Repeated repeated) {
  const bool solid = corners == 4;
  const std::string name = solid ? "tetrahedron" : "triangle", names = solid ? "tetrahedra" : "triangles";
  check_simplices(vertices, simplices, corners, name, names);
  auto mesh = std::make_shared<RegionMesh>();
  mesh->kind = solid ? DomainKind::volume : DomainKind::surface;
  mesh->shape = solid ? RegionShape::tetrahedron : RegionShape::polygon;
  mesh->dimension = 3;
  mesh->cell_dimension = solid ? 3 : 2;
  mesh->vertices.assign(vertices.begin(), vertices.end());
  mesh->region_vertex.reserve(simplices.size());

  const auto width = static_cast<std::uint32_t>(corners);
  CompensatedSum<long double> sum;
  auto next_repeated = repeated.cbegin();
  for (std::size_t k = 0; k < simplices.size(); k += width) {
    const auto index = static_cast<std::uint32_t>(k / width);
    if (next_repeated != repeated.cend() && (*next_repeated)[0] == index) {
      ++next_repeated;
      continue;
    }
    const double* at[4];
    for (std::size_t c = 0; c < width; ++c) at[c] = &vertices[3 * std::size_t{simplices[k + c]}];
    const long double measure = signed_measure(at);
    if (measure == 0) {
      mesh->report.flat.push_back(index);
      continue;
    }
    sum.add(std::fabs(measure));
    mesh->region_vertex.insert(mesh->region_vertex.end(), &simplices[k], &simplices[k] + width);
    if (measure < 0) std::swap(mesh->region_vertex.end()[-1], mesh->region_vertex.end()[-2]);
    mesh->source.push_back(index);
  }
  if (mesh->source.empty()) {
    throw Error(
        ErrorCode::invalid_domain,
        "the domain is empty: all " + std::to_string(simplices.size() / width) + " " + names + " are flat");
  }
  mesh->report.repeated = std::move(repeated);
  for (std::uint32_t r = 0; r <= mesh->source.size(); ++r) mesh->region_offset.push_back(width * r);
  mesh->facet_offset = mesh->region_offset;
  finish(*mesh, sum);
  return mesh;
}

}  // namespace powercell
