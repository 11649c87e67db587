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
  nb::class_<Cells>(m, "Cells")
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
      .def_prop_ro("shift", [](nb::handle self) { return shifts(nb::cast<Cells&>(self), self); })
      .POWERCELL_VECTOR(Cells, loop_offset)
      .POWERCELL_VECTOR(Cells, loop);
  nb::class_<JoinedCells>(m, "JoinedCells")
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
      .def_prop_ro("shift", [](nb::handle self) { return shifts(nb::cast<JoinedCells&>(self), self); });
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
      .def_ro("rounds", &Timings::rounds)
      .def_ro("reused", &Timings::reused);
}

}  // namespace powercell::python
