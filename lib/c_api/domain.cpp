#include <powercell/regions.hpp>

#include "lib/c_api/handles.hpp"

namespace powercell::c_api {
namespace {

Ring ring(const double* points, std::size_t first, std::size_t last) {
  require(first <= last, "ring_offset must not decrease");
  Ring result;
  for (std::size_t i = first; i < last; ++i) result.push_back({points[2 * i], points[2 * i + 1]});
  return result;
}

Domain polygon(const double* points, const size_t* ring_offset, const size_t* part_offset, size_t parts) {
  require(points && ring_offset && part_offset, "points, ring_offset and part_offset must not be NULL");
  std::vector<PolygonPart> polygon(parts);
  for (size_t p = 0; p < parts; ++p) {
    require(part_offset[p] < part_offset[p + 1], "each part needs at least its outer ring");
    for (size_t r = part_offset[p]; r < part_offset[p + 1]; ++r) {
      Ring next = ring(points, ring_offset[r], ring_offset[r + 1]);
      if (r == part_offset[p])
        polygon[p].outer = std::move(next);
      else
        polygon[p].holes.push_back(std::move(next));
    }
  }
  return Domain::polygon(polygon);
}

/// A function of Domain that takes vertices and elements of `corners` corners.
template <Domain (*make)(std::span<const double>, std::span<const std::uint32_t>)>
pc_status mesh(const double* vertices, size_t vertex_count, const uint32_t* elements, size_t element_count,
               size_t corners, const char* name, pc_domain** domain) {
  return guarded([&] {
    result_at(domain);
    hand_over(domain, make(rows_view(vertices, vertex_count, 3, "vertices"),
                           rows_view(elements, element_count, corners, name)));
  });
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_domain_polygon(const double* points, const size_t* ring_offset, const size_t* part_offset,
                            size_t parts, pc_domain** domain) {
  return guarded([&] {
    result_at(domain);
    hand_over(domain, polygon(points, ring_offset, part_offset, parts));
  });
}

pc_status pc_domain_surface(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                            size_t triangle_count, pc_domain** domain) {
  return mesh<&Domain::surface>(vertices, vertex_count, triangles, triangle_count, 3, "triangles", domain);
}

pc_status pc_domain_solid(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                          size_t triangle_count, pc_domain** domain) {
  return mesh<&Domain::solid>(vertices, vertex_count, triangles, triangle_count, 3, "triangles", domain);
}

pc_status pc_domain_volume(const double* vertices, size_t vertex_count, const uint32_t* tetrahedra,
                           size_t tetrahedron_count, pc_domain** domain) {
  return mesh<&Domain::volume>(vertices, vertex_count, tetrahedra, tetrahedron_count, 4, "tetrahedra",
                               domain);
}

pc_status pc_domain_box(const double* low, const double* high, int dimension, pc_domain** domain) {
  return guarded([&] {
    result_at(domain);
    const std::size_t d = coordinates(dimension);
    hand_over(domain, Domain::box(view(low, d, "low"), view(high, d, "high")));
  });
}

pc_status pc_domain_periodic_box(const double* low, const double* high, const int* periodic, int dimension,
                                 pc_domain** domain) {
  return guarded([&] {
    result_at(domain);
    const std::size_t d = coordinates(dimension);
    bool axes[3] = {};
    for (std::size_t k = 0; k < d; ++k) axes[k] = !periodic || periodic[k] != 0;
    hand_over(domain, Domain::periodic_box(view(low, d, "low"), view(high, d, "high"), std::span(axes, d)));
  });
}

pc_status pc_domain_lattice(const double* vectors, const double* origin, int dimension, pc_domain** domain) {
  return guarded([&] {
    result_at(domain);
    const std::size_t d = coordinates(dimension);
    hand_over(domain, Domain::lattice(view(vectors, d * d, "vectors"), optional_view(origin, d)));
  });
}

void pc_domain_destroy(pc_domain* domain) {
  delete domain;
}

pc_status pc_domain_measure(const pc_domain* domain, double* measure) {
  return guarded([&] { result_at(measure) = domain_in(domain).measure(); });
}

pc_status pc_domain_info_view(const pc_domain* domain, const pc_domain_info** info) {
  return guarded([&] { result_at(info) = &checked(domain, "domain").info; });
}

pc_status pc_domain_report_view(const pc_domain* domain, const pc_mesh_report** report) {
  return guarded([&] { result_at(report) = &checked(domain, "domain").report; });
}

pc_status pc_domain_regions_view(const pc_domain* domain, const pc_regions** regions) {
  return guarded([&] { result_at(regions) = &checked(domain, "domain").regions; });
}

pc_status pc_domain_wrap(const pc_domain* domain, const double* positions, size_t count, double* wrapped) {
  return guarded([&] {
    const Domain& in = domain_in(domain);
    if (count != 0) result_at(wrapped);
    copy_out(in.wrapped(positions_of(in.dimension(), positions, count)), wrapped);
  });
}

pc_status pc_domain_random_points(const pc_domain* domain, size_t count, uint64_t random_seed,
                                  uint32_t* region, double* points) {
  return guarded([&] {
    const auto d = static_cast<std::size_t>(domain_in(domain).dimension());
    if (count != 0) result_at(points);
    const std::vector<RegionPoint> drawn = random_points(domain_in(domain), count, random_seed);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (region) region[i] = drawn[i].region;
      std::copy_n(drawn[i].point.begin(), d, points + i * d);
    }
  });
}

}  // extern "C"
