#include <algorithm>
#include <powercell/domain.hpp>
#include <powercell/regions.hpp>

#include "lib/base/float_environment.hpp"
#include "lib/base/threads.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/period.hpp"
#include "lib/domain/region_mesh.hpp"
#include "lib/report/log.hpp"

namespace powercell {

namespace {

/// Writes the notes of a new mesh domain to the log.
Domain logged(Domain domain) {
  for (const std::string& note : domain.notes()) write_log(LogLevel::info, [&] { return "domain: " + note; });
  return domain;
}

}  // namespace

Domain Domain::polygon(std::span<const PolygonPart> parts) {
  const FloatEnvironment environment;
  return Domain(build_polygon(parts));
}

Domain Domain::surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles) {
  const FloatEnvironment environment;
  return logged(Domain(build_surface(vertices, triangles)));
}

Domain Domain::volume(std::span<const double> vertices, std::span<const std::uint32_t> tetrahedra) {
  const FloatEnvironment environment;
  return logged(Domain(build_volume(vertices, tetrahedra)));
}

Domain Domain::solid(std::span<const double> vertices, std::span<const std::uint32_t> triangles) {
  const FloatEnvironment environment;
  return logged(Domain(build_solid(vertices, triangles)));
}

Domain Domain::box(std::span<const double> low, std::span<const double> high) {
  const FloatEnvironment environment;
  return Domain(build_box(low, high));
}

Domain Domain::periodic_box(std::span<const double> low, std::span<const double> high,
                            std::span<const bool> periodic) {
  const FloatEnvironment environment;
  return Domain(build_periodic_box(low, high, periodic));
}

Domain Domain::periodic_box(std::span<const double> low, std::span<const double> high) {
  const FloatEnvironment environment;
  constexpr bool all[] = {true, true, true};
  return periodic_box(low, high, std::span(all).first(std::min<std::size_t>(low.size(), 3)));
}

Domain Domain::lattice(std::span<const double> vectors, std::span<const double> origin) {
  const FloatEnvironment environment;
  return Domain(build_lattice(vectors, origin));
}

bool Domain::is_periodic() const {
  return mesh_->period != nullptr;
}
std::array<std::array<double, 3>, 3> Domain::periods() const {
  std::array<std::array<double, 3>, 3> vectors{};
  for (int k = 0; k < 3 && is_periodic(); ++k) vectors[static_cast<std::size_t>(k)] = mesh_->period->given(k);
  return vectors;
}

std::vector<double> Domain::wrapped(std::span<const double> positions) const {
  const FloatEnvironment environment;
  const auto d = static_cast<std::size_t>(dimension());
  if (positions.size() % d != 0)
    throw Error(ErrorCode::invalid_argument,
                std::to_string(positions.size()) + " coordinates of points of " + std::to_string(d));
  std::vector<double> result(positions.begin(), positions.end());
  if (!is_periodic()) return result;
  const std::size_t far = wrap_all(*mesh_->period, positions, thread_count(0), result);
  if (far < positions.size() / d) refuse_far(far);
  return result;
}

DomainKind Domain::kind() const {
  return mesh_->kind;
}
int Domain::dimension() const {
  return mesh_->dimension;
}
int Domain::cell_dimension() const {
  return mesh_->cell_dimension;
}
double Domain::measure() const {
  return mesh_->measure;
}
std::array<double, 3> Domain::low() const {
  return mesh_->low;
}
std::array<double, 3> Domain::high() const {
  return mesh_->high;
}
std::size_t Domain::region_count() const {
  return mesh_->region_count();
}

bool Domain::is_solid() const {
  return mesh_->solid_boundary != nullptr;
}

const MeshReport& Domain::report() const {
  return mesh_->report;
}

RegionsView Domain::regions() const {
  return {mesh_->shape,         mesh_->dimension,     mesh_->cell_dimension, mesh_->vertices,
          mesh_->region_offset, mesh_->region_vertex, mesh_->facet_offset,   mesh_->facet,
          mesh_->source,        mesh_->boundary_count};
}

}  // namespace powercell
