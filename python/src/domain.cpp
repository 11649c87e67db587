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

nb::object facets(nb::handle self) {
  const std::span all = nb::cast<RegionsView&>(self).facet;
  return view(reinterpret_cast<const std::uint32_t*>(all.data()), {all.size(), 2}, self);
}

const char* name_of(RegionShape shape) {
  switch (shape) {
    case RegionShape::polygon:
      return "polygon";
    case RegionShape::tetrahedron:
      return "tetrahedron";
    default:
      return "box";
  }
}

#define POWERCELL_VECTOR(member)                               \
  def_prop_ro(#member, [](nb::handle self) {                   \
    const std::span all = nb::cast<RegionsView&>(self).member; \
    return view(all.data(), {all.size()}, self);               \
  })

void bind_regions(nb::module_& m) {
  nb::class_<RegionsView>(m, "RegionsView", R"(The convex regions of a domain.

Region r has the vertices ``region_vertex[region_offset[r]:region_offset[r + 1]]`` and the facets
``facet[facet_offset[r]:facet_offset[r + 1]]``: of a polygon, edge k from its vertex k to vertex k + 1; of a
tetrahedron, facet k opposite vertex k; of a box, -x +x -y +y -z +z.

Attributes
----------
shape : str
    ``"polygon"`` (counter-clockwise), ``"tetrahedron"`` (positively oriented) or ``"box"`` (corner k is low along x
    where ``k & 1`` is 0, along y for ``k & 2``, along z for ``k & 4``).
dimension, cell_dimension : int
    Of a vertex, and of the regions.
vertices : (nv, dimension) float64
region_offset, facet_offset : (regions + 1,) uint32
region_vertex : (m,) uint32
facet : (k, 2) uint32
    Rows (kind, index): 1 and the number of a boundary facet, or 2 and the region behind it.
source : (regions,) uint32
    The part, triangle or tetrahedron of the input.
boundary_count : int
    Number of boundary facets.)")
      .def_prop_ro("shape", [](const RegionsView& r) { return name_of(r.shape); })
      .def_ro("dimension", &RegionsView::dimension)
      .def_ro("cell_dimension", &RegionsView::cell_dimension)
      .def_prop_ro("vertices",
                   [](nb::handle self) {
                     const RegionsView& r = nb::cast<RegionsView&>(self);
                     const auto d = static_cast<std::size_t>(r.dimension);
                     return view(r.vertices.data(), {d ? r.vertices.size() / d : 0, d}, self);
                   })
      .POWERCELL_VECTOR(region_offset)
      .POWERCELL_VECTOR(region_vertex)
      .POWERCELL_VECTOR(facet_offset)
      .def_prop_ro("facet", &facets)
      .POWERCELL_VECTOR(source)
      .def_ro("boundary_count", &RegionsView::boundary_count)
      .def("__len__", &RegionsView::size);
}

void bind_reports(nb::module_& m) {
  nb::class_<Overlap>(m, "Overlap", R"(Two triangles or tetrahedra of a mesh that overlap.

Attributes
----------
first, second : int
    Indices of the input, ascending.
measure : float
    Area or volume of their common part.
at : list of float
    The centroid of that part.)")
      .def_ro("first", &Overlap::first)
      .def_ro("second", &Overlap::second)
      .def_ro("measure", &Overlap::measure)
      .def_ro("at", &Overlap::at);
  nb::class_<MeshReport>(m, "MeshReport",
                         R"(The elements of a mesh that were left out, and those that overlap.

Attributes
----------
flat : (k,) uint32
    Elements without area or volume, left out.
repeated : (m, 2) uint32
    Elements with the corners of an earlier one, left out: the index of each and of the earlier one.
overlaps : int
    Pairs of the others that overlap by more than rounding; their common part counts twice.
overlap : float
    The sum of the measures of the common parts.
largest : Overlap
    The pair with the largest common part.)")
      .def_prop_ro("flat", [](nb::handle self) { return view(nb::cast<MeshReport&>(self).flat, self); })
      .def_prop_ro("repeated",
                   [](nb::handle self) {
                     const auto& all = nb::cast<MeshReport&>(self).repeated;
                     return view(all.empty() ? nullptr : all.front().data(), {all.size(), 2}, self);
                   })
      .def_ro("overlaps", &MeshReport::overlaps)
      .def_ro("overlap", &MeshReport::overlap)
      .def_ro("largest", &MeshReport::largest);
}

}  // namespace

void bind_domains(nb::module_& m) {
  bind_regions(m);
  bind_reports(m);
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
      .def_prop_ro("regions", &Domain::regions, nb::keep_alive<0, 1>())
      .def_prop_ro("report", &Domain::report)
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
