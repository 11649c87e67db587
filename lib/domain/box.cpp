#include <algorithm>
#include <cmath>

#include "lib/base/mesh_arrays.hpp"
#include "lib/base/text.hpp"
#include "lib/base/vectors.hpp"
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

void check_vectors(std::span<const double> vectors, std::size_t d, std::span<const double> origin) {
  if (vectors.size() != d * d || origin.size() != d)
    throw Error(ErrorCode::invalid_domain,
                "a lattice needs 2 vectors of 2 coordinates or 3 of 3, and an origin of as many; got " +
                    std::to_string(vectors.size()) + " coordinates of vectors and " +
                    std::to_string(origin.size()) + " of the origin");
  for (const std::span<const double> values : {vectors, origin})
    for (const double x : values)
      if (!std::isfinite(x))
        throw Error(ErrorCode::invalid_domain, "a coordinate of the lattice is not finite");
  double largest = 0;
  for (const double x : vectors) largest = std::max(largest, std::abs(x));
  check_magnitude(largest);
}

/// The order in which the vectors are positively oriented.
std::array<std::size_t, 3> right_handed(std::span<const double> v, std::size_t d) {
  using Vector = Vector3<long double>;
  const Vector a{v[0], v[1], d == 3 ? v[2] : 0}, b{v[d], v[d + 1], d == 3 ? v[5] : 0},
      c = d == 3 ? Vector{v[6], v[7], v[8]} : Vector{0, 0, 1};
  if (dot(a, cross(b, c)) > 0) return {0, 1, 2};
  return {1, 0, 2};
}

std::shared_ptr<RegionMesh> make_box(std::span<const double> low, std::span<const double> high) {
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

}  // namespace

RegionMeshPtr build_box(std::span<const double> low, std::span<const double> high) {
  return make_box(low, high);
}

RegionMeshPtr build_periodic_box(std::span<const double> low, std::span<const double> high,
                                 std::span<const bool> periodic) {
  const std::shared_ptr<RegionMesh> mesh = make_box(low, high);
  if (periodic.size() != low.size())
    throw Error(ErrorCode::invalid_argument, std::to_string(periodic.size()) +
                                                 " flags of periodic axes for " + std::to_string(low.size()) +
                                                 " axes");
  std::array<bool, 3> axes{};
  std::copy(periodic.begin(), periodic.end(), axes.begin());
  mesh->period = std::make_shared<Period>(Period::of_box(low, high, axes));
  return mesh;
}

RegionMeshPtr build_lattice(std::span<const double> vectors, std::span<const double> origin_or_none) {
  const std::size_t d = vectors.size() == 4 ? 2 : 3;
  const std::vector<double> zero(d);
  const std::span<const double> origin = origin_or_none.empty() ? zero : origin_or_none;
  check_vectors(vectors, d, origin);
  auto mesh = std::make_shared<RegionMesh>();
  mesh->period = std::make_shared<Period>(Period::of_lattice(vectors, origin));
  mesh->dimension = mesh->cell_dimension = static_cast<int>(d);
  mesh->kind = d == 2 ? DomainKind::polygon : DomainKind::volume;
  mesh->shape = d == 2 ? RegionShape::polygon : RegionShape::box;
  const std::array<std::size_t, 3> order = right_handed(vectors, d);
  for (unsigned corner = 0; corner < 1U << d; ++corner) {
    const unsigned bits = d == 2 ? corner ^ corner >> 1 : corner;  // counter-clockwise in the plane
    for (std::size_t c = 0; c < d; ++c) {
      double x = origin[c];
      for (std::size_t k = 0; k < d; ++k)
        if ((bits >> k & 1) != 0) x += vectors[order[k] * d + c];
      mesh->vertices.push_back(x);
    }
  }
  close_single_region(*mesh, static_cast<std::uint32_t>(2 * d));
  CompensatedSum<long double> sum;
  sum.add(mesh->period->measure());
  finish(*mesh, sum);
  return mesh;
}

}  // namespace powercell
