#include <powercell/results.hpp>

#include "python/src/call.hpp"

namespace powercell::python {
namespace {

static_assert(sizeof(Border) == 2 * sizeof(std::uint32_t));
static_assert(sizeof(SeedStatus) == 1);

/// Rows (kind, index).
nb::object borders(const std::vector<Border>& all, nb::handle owner) {
  return view(reinterpret_cast<const std::uint32_t*>(all.data()), {all.size(), 2}, owner);
}

template <class Result>
nb::object shifts_of(nb::handle self) {
  const Result& cells = nb::cast<Result&>(self);
  return shifts(cells, self, cells.dimension);
}

#define POWERCELL_VECTOR(Type, member) \
  def_prop_ro(#member, [](nb::handle self) { return view(nb::cast<Type&>(self).member, self); })

}  // namespace

void bind_results(nb::module_& m) {
  nb::class_<Adjacency>(m, "Adjacency")
      .def_prop_ro("indptr", [](nb::handle self) { return view(nb::cast<Adjacency&>(self).offset, self); })
      .def_prop_ro("indices", [](nb::handle self) { return view(nb::cast<Adjacency&>(self).neighbor, self); })
      .def_prop_ro("data", [](nb::handle self) { return view(nb::cast<Adjacency&>(self).wall, self); })
      .def_prop_ro("shift", [](nb::handle self) { return shifts(nb::cast<Adjacency&>(self), self); })
      .def_ro("asymmetry", &Adjacency::asymmetry)
      .def_prop_ro("asymmetric",
                   [](const Adjacency& a) { return nb::make_tuple(a.asymmetric[0], a.asymmetric[1]); });
  nb::class_<BoundaryWalls>(m, "BoundaryWalls")
      .def_prop_ro("indptr",
                   [](nb::handle self) { return view(nb::cast<BoundaryWalls&>(self).offset, self); })
      .def_prop_ro("indices",
                   [](nb::handle self) { return view(nb::cast<BoundaryWalls&>(self).facet, self); })
      .def_prop_ro("data",
                   [](nb::handle self) { return view(nb::cast<BoundaryWalls&>(self).measure, self); });
  nb::class_<Cells>(m, "Cells",
                    R"(The convex pieces of the cells, one for each region of the domain that a cell meets.

Cell i has the pieces ``cell_offset[i]`` to ``cell_offset[i + 1]``. Offsets and indices are int64 and int32.

Attributes
----------
dimension, cell_dimension : int
    Of vertices, and of the pieces: 2 in polygons and on surfaces, 3 in volumes.
cell_offset : (n + 1,)
region : (pieces,)
    The region of the domain in which a piece lies.
vertex_offset : (pieces + 1,)
vertices : (v, d) float64
    In the plane and on surfaces those of a piece go around it counter-clockwise.
face_offset : (pieces + 1,)
border : (faces, 2)
    Kind and index of the other side: 0 the cell of a seed, 1 a facet of the domain, 2 the same cell in another region.
    In the plane and on surfaces face k is the edge from vertex k to the next.
shift : (faces, d) or None
    In a periodic domain the image of the neighbour, as in :class:`Adjacency`.
loop_offset : (faces + 1,)
loop : (l,)
    In volumes: the corners of each face, counter-clockwise from outside, as indices within the piece's vertices.)")
      .def_ro("dimension", &Cells::dimension)
      .def_ro("cell_dimension", &Cells::cell_dimension)
      .POWERCELL_VECTOR(Cells, cell_offset)
      .POWERCELL_VECTOR(Cells, region)
      .POWERCELL_VECTOR(Cells, vertex_offset)
      .def_prop_ro("vertices",
                   [](nb::handle self) {
                     const Cells& c = nb::cast<Cells&>(self);
                     return rows(c.vertices, static_cast<std::size_t>(c.dimension), self);
                   })
      .POWERCELL_VECTOR(Cells, face_offset)
      .def_prop_ro("border", [](nb::handle self) { return borders(nb::cast<Cells&>(self).border, self); })
      .def_prop_ro("shift", &shifts_of<Cells>)
      .POWERCELL_VECTOR(Cells, loop_offset)
      .POWERCELL_VECTOR(Cells, loop);
  nb::class_<JoinedCells>(m, "JoinedCells", R"(Whole cells, without the faces between their pieces.

Cell i has the vertices ``vertex_offset[i]`` to ``vertex_offset[i + 1]`` and the faces ``face_offset[i]`` to
``face_offset[i + 1]``. In polygons the faces are its boundary rings, outer ones counter-clockwise and holes
clockwise; on surfaces its polygon in each triangle; in volumes polygons on its boundary, counter-clockwise seen
from outside. Offsets and indices are int64 and int32.

Attributes
----------
dimension, cell_dimension : int
    Of vertices, and of the cells: 2 in polygons and on surfaces, 3 in volumes.
vertex_offset : (n + 1,)
vertices : (v, d) float64
face_offset : (n + 1,)
face_border : (faces, 2)
    In volumes: kind and index of a face's other side: 0 the cell of a seed, 1 a facet of the domain.
loop_offset : (faces + 1,)
loop : (l,)
    The corners of each face, as indices within the cell's vertices.
edge_border : (l, 2)
    In polygons and on surfaces: the same of the edge that starts at each entry of ``loop``; 2 the same cell in
    another triangle.
shift : (faces or l, d) or None
    In a periodic domain the image of the neighbour, as in :class:`Adjacency`.

Examples
--------
>>> import powercell as pc
>>> cells = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[0.25, 0.5], [0.75, 0.5]]).joined
>>> corners = cells.vertices[cells.vertex_offset[1] : cells.vertex_offset[2]]
>>> ring = cells.loop[cells.loop_offset[1] : cells.loop_offset[2]]
>>> sorted(corners[ring].tolist())
[[0.5, 0.0], [0.5, 1.0], [1.0, 0.0], [1.0, 1.0]])")
      .def_ro("dimension", &JoinedCells::dimension)
      .def_ro("cell_dimension", &JoinedCells::cell_dimension)
      .POWERCELL_VECTOR(JoinedCells, vertex_offset)
      .def_prop_ro("vertices",
                   [](nb::handle self) {
                     const JoinedCells& c = nb::cast<JoinedCells&>(self);
                     return rows(c.vertices, static_cast<std::size_t>(c.dimension), self);
                   })
      .POWERCELL_VECTOR(JoinedCells, face_offset)
      .def_prop_ro("face_border",
                   [](nb::handle self) { return borders(nb::cast<JoinedCells&>(self).face_border, self); })
      .POWERCELL_VECTOR(JoinedCells, loop_offset)
      .POWERCELL_VECTOR(JoinedCells, loop)
      .def_prop_ro("edge_border",
                   [](nb::handle self) { return borders(nb::cast<JoinedCells&>(self).edge_border, self); })
      .def_prop_ro("shift", &shifts_of<JoinedCells>);
  nb::class_<Timings>(m, "Timings", "Seconds spent in each part of the last computation, and counts.")
      .def_ro("total", &Timings::total)
      .def_ro("prepare", &Timings::prepare)
      .def_ro("pairs", &Timings::pairs)
      .def_ro("neighbors", &Timings::neighbors)
      .def_ro("clip", &Timings::clip)
      .def_ro("collect", &Timings::collect)
      .def_ro("certify", &Timings::certify)
      .def_ro("build", &Timings::build)
      .def_ro("pair_count", &Timings::pair_count)
      .def_ro("retried", &Timings::retried)
      .def_ro("on_host", &Timings::on_host)
      .def_ro("uncertain", &Timings::uncertain)
      .def_ro("rounds", &Timings::rounds);
}

}  // namespace powercell::python
