#include <powercell/treemap.hpp>

#include "python/src/call.hpp"
#include "python/src/options.hpp"

namespace powercell::python {
namespace {

Treemap lay_out(const Vector<std::int64_t>& parent, const Vector<double>& value,
                const Matrix<double>& outline, const std::optional<Matrix<double>>& start,
                const nb::dict& given, const std::optional<Device>& device, nb::object progress) {
  TreemapOptions options;
  options.tolerance = nb::cast<double>(given["tolerance"]);
  options.rounds = whole<int>(given, "rounds");
  options.random_seed = whole<std::uint64_t>(given, "random_seed");
  options.threads = whole<int>(given, "threads");
  if (start) options.start = span_of(*start);
  const auto names = nb::cast<std::vector<std::string>>(given["names"]);
  if (!names.empty()) options.name = [&](std::size_t node) { return names[node]; };
  options.large_group = whole<std::size_t>(given, "large_group");
  options.device = device;
  Ring ring;
  for (std::size_t k = 0; k < outline.shape(0); ++k)
    ring.push_back({outline.data()[2 * k], outline.data()[2 * k + 1]});
  Call call(std::move(progress));
  options.progress = [&](double fraction) { return call.report(fraction); };
  const TreeView tree{span_of(parent), span_of(value)};
  return call.run([&] { return treemap(tree, ring, options); });
}

nb::object kinds(nb::handle self) {
  const auto& kind = nb::cast<Treemap&>(self).kind;
  return view(reinterpret_cast<const std::uint8_t*>(kind.data()), {kind.size()}, self);
}

#define POWERCELL_VECTOR(member) \
  def_prop_ro(#member, [](nb::handle self) { return view(nb::cast<Treemap&>(self).member, self); })

}  // namespace

void bind_treemaps(nb::module_& m) {
  nb::class_<Treemap>(m, "Treemap", "A layout; arrays are indexed by node.")
      .def_prop_ro("kind", &kinds)
      .POWERCELL_VECTOR(value)
      .POWERCELL_VECTOR(depth)
      .POWERCELL_VECTOR(vertex_offset)
      .def_prop_ro("vertices",
                   [](nb::handle self) { return rows(nb::cast<Treemap&>(self).vertices, 2, self); })
      .def_prop_ro("seeds", [](nb::handle self) { return rows(nb::cast<Treemap&>(self).seeds, 2, self); })
      .def_ro("worst_error", &Treemap::worst_error)
      .def_ro("worst_leaf", &Treemap::worst_leaf)
      .def_ro("mean_aspect", &Treemap::mean_aspect)
      .def_ro("leaves", &Treemap::leaves)
      .def_ro("not_converged", &Treemap::not_converged)
      .def_ro("diagrams", &Treemap::diagrams)
      .def_ro("newton_steps", &Treemap::newton_steps);
  m.def("treemap", &lay_out, "parent"_a, "value"_a, "outline"_a, "start"_a.none(), "given"_a,
        "device"_a.none(), "progress"_a.none());
  m.def("relative_positions", [](const Vector<std::int64_t>& parent, const Treemap& earlier) {
    return relative_positions(span_of(parent), earlier.seeds, earlier.vertex_offset, earlier.vertices);
  });
}

}  // namespace powercell::python
