#include <powercell/remeshing.hpp>

#include "python/src/call.hpp"
#include "python/src/options.hpp"

namespace powercell::python {
namespace {

using Triangles = Matrix<std::uint32_t>;

RemeshResult remesh_with(const Matrix<double>& vertices, const Triangles& triangles, const nb::dict& given,
                         const std::optional<Device>& device, nb::object progress) {
  RemeshOptions options;
  options.method =
      chosen<RemeshMethod>("method", nb::cast<std::string>(given["method"]),
                           {{"fpo", RemeshMethod::farthest_point}, {"transport", RemeshMethod::transport}});
  options.count = whole<std::size_t>(given, "count");
  options.gradation = nb::cast<double>(given["gradation"]);
  options.contrast = nb::cast<double>(given["contrast"]);
  options.sharp_angle = nb::cast<double>(given["sharp_angle"]);
  options.rounds = whole<int>(given, "rounds");
  options.relaxations = whole<int>(given, "relaxations");
  options.random_seed = whole<std::uint64_t>(given, "random_seed");
  options.repair = nb::cast<bool>(given["repair"]);
  options.device = device;
  Call call(std::move(progress));
  options.progress = [&](double fraction) { return call.report(fraction); };
  const std::span positions = span_of(vertices);
  const std::span corners = span_of(triangles);
  return call.run([&] { return remesh(positions, corners, options); });
}

nb::object fixed(const RemeshResult& result) {
  nb::list values;
  for (const bool f : result.fixed) values.append(f);
  return values;
}

}  // namespace

void bind_remeshing(nb::module_& m) {
  nb::class_<RepairCount>(m, "RepairCount", R"(How often something was done or found.

Attributes
----------
count : int
first : list of float
    A place of the first time.)")
      .def_ro("count", &RepairCount::count)
      .def_ro("first", &RepairCount::first);
  nb::class_<RepairReport>(m, "RepairReport", "What was done to a mesh, and what was left.")
      .def_prop_ro("acts", &RepairReport::acts)
      .def_prop_ro("left", &RepairReport::left)
      .def_ro("degenerate", &RepairReport::degenerate)
      .def_ro("repeated", &RepairReport::repeated)
      .def_ro("split_edges", &RepairReport::split_edges)
      .def_ro("split_vertices", &RepairReport::split_vertices)
      .def_ro("welded", &RepairReport::welded)
      .def_ro("turned", &RepairReport::turned)
      .def_ro("flat", &RepairReport::flat)
      .def_ro("left_flat", &RepairReport::left_flat)
      .def_ro("intersections", &RepairReport::intersections)
      .def_prop_ro("changed", &RepairReport::changed)
      .def_ro("components", &RepairReport::components)
      .def_ro("boundary_edges", &RepairReport::boundary_edges)
      .def_ro("moved", &RepairReport::moved);
  nb::class_<RepairedMesh>(m, "RepairedMesh")
      .def_ro("mesh", &RepairedMesh::mesh)
      .def_ro("report", &RepairedMesh::report);
  nb::class_<MeshQuality>(m, "MeshQuality", "Quality of a triangle mesh.")
      .def_ro("vertices", &MeshQuality::vertices)
      .def_ro("triangles", &MeshQuality::triangles)
      .def_ro("q_min", &MeshQuality::q_min)
      .def_ro("q_mean", &MeshQuality::q_mean)
      .def_ro("angle_min", &MeshQuality::angle_min)
      .def_ro("angle_max", &MeshQuality::angle_max)
      .def_ro("angle_min_mean", &MeshQuality::angle_min_mean)
      .def_ro("below_30", &MeshQuality::below_30)
      .def_ro("regular", &MeshQuality::regular)
      .def_ro("euler_characteristic", &MeshQuality::euler_characteristic)
      .def_ro("boundary_loops", &MeshQuality::boundary_loops)
      .def_ro("manifold", &MeshQuality::manifold);
  nb::class_<RemeshResult>(m, "RemeshResult", "A new mesh; its vertices lie on the old one.")
      .def_prop_ro("vertices",
                   [](nb::handle self) { return rows(nb::cast<RemeshResult&>(self).mesh.vertices, 3, self); })
      .def_prop_ro(
          "triangles",
          [](nb::handle self) { return rows(nb::cast<RemeshResult&>(self).mesh.triangles, 3, self); })
      .def_prop_ro("sizing", [](nb::handle self) { return view(nb::cast<RemeshResult&>(self).sizing, self); })
      .def_prop_ro("least_spacing",
                   [](nb::handle self) { return view(nb::cast<RemeshResult&>(self).least_spacing, self); })
      .def_prop_ro("fixed", &fixed)
      .def_ro("repair", &RemeshResult::repair)
      .def_ro("added", &RemeshResult::added)
      .def_ro("collapsed", &RemeshResult::collapsed)
      .def_ro("inseparable", &RemeshResult::inseparable)
      .def_ro("intersections", &RemeshResult::intersections)
      .def_ro("seconds_sample", &RemeshResult::seconds_sample)
      .def_ro("seconds_dual", &RemeshResult::seconds_dual)
      .def_ro("seconds_relax", &RemeshResult::seconds_relax);
  m.def("remesh", &remesh_with, "vertices"_a, "triangles"_a, "given"_a, "device"_a.none(),
        "progress"_a.none());
  m.def("repair", [](const Matrix<double>& vertices, const Triangles& triangles, double weld) {
    const std::span positions = span_of(vertices);
    const std::span corners = span_of(triangles);
    return without_lock([&] { return repair(positions, corners, {weld}); });
  });
  m.def("mesh_quality", [](const Matrix<double>& vertices, const Triangles& triangles) {
    return mesh_quality(span_of(vertices), span_of(triangles));
  });
}

}  // namespace powercell::python
