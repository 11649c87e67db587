#include <powercell/domain.hpp>
#include <powercell/regions.hpp>
#include <powercell/shapes.hpp>

#include "python/src/call.hpp"

namespace powercell::python {
namespace {

const char* kind_of(DomainKind kind) {
  switch (kind) {
    case DomainKind::polygon:
      return "polygon";
    case DomainKind::surface:
      return "surface";
    default:
      return "volume";
  }
}

/// \param parts  per part its rings, the outer one first
Domain polygon(const std::vector<std::vector<Matrix<double>>>& parts) {
  std::vector<PolygonPart> result;
  for (const auto& rings : parts) {
    PolygonPart& part = result.emplace_back();
    for (std::size_t r = 0; r < rings.size(); ++r) {
      Ring& ring = r == 0 ? part.outer : part.holes.emplace_back();
      for (std::size_t k = 0; k < rings[r].shape(0); ++k)
        ring.push_back({rings[r].data()[2 * k], rings[r].data()[2 * k + 1]});
    }
  }
  return without_lock([&] { return Domain::polygon(result); });
}

template <Domain (*make)(std::span<const double>, std::span<const std::uint32_t>)>
Domain mesh(const Matrix<double>& vertices, const Matrix<std::uint32_t>& elements) {
  return without_lock([&] { return make(span_of(vertices), span_of(elements)); });
}

Domain box(const std::vector<double>& low, const std::vector<double>& high,
           const std::vector<bool>& periodic) {
  bool axes[3] = {};
  bool any = false;
  for (std::size_t k = 0; k < periodic.size() && k < 3; ++k) any |= axes[k] = periodic[k];
  return any ? Domain::periodic_box(low, high, std::span(axes, periodic.size())) : Domain::box(low, high);
}

nb::object corner(const Domain& domain, const std::array<double, 3>& of) {
  nb::list values;
  for (int k = 0; k < domain.dimension(); ++k) values.append(of[static_cast<std::size_t>(k)]);
  return nb::tuple(values);
}

nb::object periods(const Domain& domain) {
  nb::list values;
  const auto all = domain.periods();
  for (int k = 0; k < domain.dimension(); ++k)
    values.append(corner(domain, all[static_cast<std::size_t>(k)]));
  return nb::tuple(values);
}

}  // namespace

void bind_domains(nb::module_& m) {
  nb::class_<Domain>(m, "Domain")
      .def_static("box", &box)
      .def_static("lattice",
                  [](const std::vector<double>& vectors, const std::vector<double>& origin) {
                    return Domain::lattice(vectors, origin);
                  })
      .def_static("polygon", &polygon)
      .def_static("surface", &mesh<&Domain::surface>)
      .def_static("volume", &mesh<&Domain::volume>)
      .def_static("solid", &mesh<&Domain::solid>)
      .def("wrapped", [](const Domain& domain,
                         const Matrix<double>& positions) { return domain.wrapped(span_of(positions)); })
      .def_prop_ro("is_solid", &Domain::is_solid)
      .def_prop_ro("kind", [](const Domain& d) { return kind_of(d.kind()); })
      .def_prop_ro("dimension", &Domain::dimension)
      .def_prop_ro("cell_dimension", &Domain::cell_dimension)
      .def_prop_ro("measure", &Domain::measure)
      .def_prop_ro("is_periodic", &Domain::is_periodic)
      .def_prop_ro("periods", &periods)
      .def_prop_ro("low", [](const Domain& d) { return corner(d, d.low()); })
      .def_prop_ro("high", [](const Domain& d) { return corner(d, d.high()); })
      .def_prop_ro("region_count", &Domain::region_count)
      .def_prop_ro("notes", &Domain::notes);

  m.def("shape_disk", [](int segments) { return disk(segments); });
  m.def("shape_sphere", [](int resolution) { return sphere(resolution); });
  m.def("shape_torus", [](int resolution) { return torus(resolution); });
  m.def("shape_ball", [](int resolution) { return ball(resolution); });
  nb::class_<TriangleMesh>(m, "TriangleMesh")
      .def_prop_ro("vertices",
                   [](nb::handle self) { return rows(nb::cast<TriangleMesh&>(self).vertices, 3, self); })
      .def_prop_ro("triangles",
                   [](nb::handle self) { return rows(nb::cast<TriangleMesh&>(self).triangles, 3, self); });
  nb::class_<TetrahedralMesh>(m, "TetrahedralMesh")
      .def_prop_ro("vertices",
                   [](nb::handle self) { return rows(nb::cast<TetrahedralMesh&>(self).vertices, 3, self); })
      .def_prop_ro("tetrahedra", [](nb::handle self) {
        return rows(nb::cast<TetrahedralMesh&>(self).tetrahedra, 4, self);
      });
}

}  // namespace powercell::python
