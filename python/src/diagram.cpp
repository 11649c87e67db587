#include <nanobind/stl/shared_ptr.h>

#include <powercell/diagram.hpp>
#include <powercell/triangulation.hpp>
#include <powercell/verify.hpp>

#include "apps/io/write/formats.hpp"
#include "python/src/call.hpp"
#include "python/src/density.hpp"
#include "python/src/options.hpp"
#include "python/src/seeds.hpp"

namespace powercell::python {
namespace {

/// A diagram whose results Python sees in place: they are shared with it.
class PyDiagram {
 public:
  PyDiagram(const Device& device, const Domain& domain, const nb::dict& options)
      : diagram_(device, domain, with_progress(options_of(options))) {}

  void set_seeds(const Matrix<double>& positions, const Weights& weights) {
    const SeedsView seeds = seeds_of(positions, weights);
    slot_.run(nb::none(), [&] { diagram_.set_seeds(seeds); });
  }
  void set_weights(const Vector<double>& weights) {
    const std::span all = span_of(weights);
    slot_.run(nb::none(), [&] { diagram_.set_weights(all); });
  }
  void select(const Vector<std::uint32_t>& seeds) {
    const std::span all = span_of(seeds);
    slot_.run(nb::none(), [&] { diagram_.select(all); });
  }
  void select_all() {
    slot_.run(nb::none(), [&] { diagram_.select_all(); });
  }
  void compute(bool adjacency, bool cells, const nb::object& progress) {
    slot_.run(progress, [&] { diagram_.compute(adjacency, cells); });
  }

  std::shared_ptr<Measures> measures() { return held(&Diagram::measures); }
  std::shared_ptr<Adjacency> adjacency() { return held(&Diagram::adjacency); }
  std::shared_ptr<BoundaryWalls> boundary_walls() { return held(&Diagram::boundary_walls); }
  std::shared_ptr<Cells> cells() { return held(&Diagram::cells); }
  std::shared_ptr<Dual> dual() { return held(&Diagram::dual); }
  std::shared_ptr<JoinedCells> joined() { return held(&Diagram::joined); }
  std::vector<LawCheck> verify(const Matrix<double>& positions, const Weights& weights, const nb::dict& given,
                               const nb::object& progress) {
    const SeedsView seeds = seeds_of(positions, weights);
    const auto samples = whole<std::size_t>(given, "samples");
    const auto random_seed = whole<std::uint64_t>(given, "random_seed");
    return slot_.run(progress, [&] {
      const Checking checking(this);
      return powercell::verify(diagram_, seeds, {samples, random_seed, [this](double fraction) {
                                                   return slot_.report(fraction);
                                                 }});
    });
  }
  DensityIntegrals integrate(const nb::tuple& density, const nb::dict& given, const nb::object& progress) {
    const Density of = density_of(density, slot_, diagram_.domain().dimension());
    const IntegrationOptions options = integration_options(given, slot_);
    return slot_.run(progress, [&] { return powercell::integrate(diagram_, of, options); });
  }

  /// \param fields  of the columns `names`, row by row
  void write_html(const std::string& path, const Matrix<double>& positions, const Weights& weights,
                  std::vector<std::string> names, const std::vector<std::string>& fields,
                  const nb::object& progress) {
    const SeedsView seeds = seeds_of(positions, weights);
    io::SeedTable table;
    table.text.columns = names.size();
    for (const std::string& field : fields) table.text.add(field);
    table.columns.names = std::move(names);
    slot_.run(progress, [&] {
      io::check_output(path, diagram_.domain(), seeds.size());
      diagram_.compute(true, true);
      const Cells none;
      const bool solid = diagram_.domain().is_solid();  // its page is made of the joined cells
      io::write_html(path, {diagram_.domain(),
                            seeds,
                            diagram_.measures(),
                            solid ? none : diagram_.cells(),
                            diagram_.joined(),
                            diagram_.adjacency(),
                            true,
                            {.table = &table, .map = nullptr}});
    });
  }

  const Diagram& diagram() const { return diagram_; }

 private:
  Options with_progress(Options options) {
    options.progress = [this](double fraction) { return checks_ ? slot_.check() : slot_.report(fraction); };
    return options;
  }

  /// A result together with what holds it, in one step: another thread may change the seeds after it.
  template <class T>
  std::shared_ptr<T> held(const T& (Diagram::*get)()) {
    return slot_.run(nb::none(), [&] {
      const T& result = (diagram_.*get)();
      return std::shared_ptr<T>(std::const_pointer_cast<void>(diagram_.hold_results()),
                                const_cast<T*>(&result));  // Python has no const; the properties are
    });
  }

  /// While one lives, computations do not report: the checks do.
  struct Checking {
    explicit Checking(PyDiagram* d) : diagram(d) { diagram->checks_ = true; }
    ~Checking() { diagram->checks_ = false; }
    PyDiagram* diagram;
  };

  CallSlot slot_;
  bool checks_ = false;  // within a call of the slot alone
  Diagram diagram_;
};

const char* name_of(Precision precision) {
  return precision == Precision::float32 ? "float" : "double";
}

nb::object simplices(nb::handle self) {
  const Dual& dual = nb::cast<Dual&>(self);
  return rows(dual.simplices, static_cast<std::size_t>(dual.corners), self);
}

}  // namespace

void bind_diagrams(nb::module_& m) {
  nb::class_<Measures>(m, "Measures")
      .def_prop_ro("mass", [](nb::handle self) { return view(nb::cast<Measures&>(self).mass, self); })
      .def_prop_ro("centroid",
                   [](nb::handle self) {
                     const Measures& all = nb::cast<Measures&>(self);
                     return rows(all.centroid, static_cast<std::size_t>(all.dimension), self);
                   })
      .def_prop_ro("second_moment",
                   [](nb::handle self) { return view(nb::cast<Measures&>(self).second_moment, self); })
      .def_prop_ro("status",
                   [](nb::handle self) {
                     const auto& status = nb::cast<Measures&>(self).status;
                     return view(reinterpret_cast<const std::uint8_t*>(status.data()), {status.size()}, self);
                   })
      .def_ro("domain_measure", &Measures::domain_measure)
      .def_prop_ro("total", &Measures::total)
      .def_prop_ro("relative_error", &Measures::relative_error);
  nb::class_<Dual>(m, "Dual")
      .def_prop_ro("simplices", &simplices)
      .def_prop_ro("shift", [](nb::handle self) -> nb::object {
        const Dual& dual = nb::cast<Dual&>(self);
        if (dual.shift.empty()) return nb::none();
        const auto corners = static_cast<std::size_t>(dual.corners);
        return view(dual.shift.front().data(), {dual.shift.size() / corners, corners, 3}, self);
      });

  nb::class_<PyDiagram>(m, "Diagram")
      .def(nb::init<const Device&, const Domain&, const nb::dict&>())
      .def("set_seeds", &PyDiagram::set_seeds, "positions"_a, "weights"_a.none())
      .def("set_weights", &PyDiagram::set_weights)
      .def("select", &PyDiagram::select)
      .def("select_all", &PyDiagram::select_all)
      .def("compute", &PyDiagram::compute, "adjacency"_a, "cells"_a, "progress"_a.none())
      .def("measures", &PyDiagram::measures)
      .def("adjacency", &PyDiagram::adjacency)
      .def("boundary_walls", &PyDiagram::boundary_walls)
      .def("cells", &PyDiagram::cells)
      .def("joined", &PyDiagram::joined)
      .def("dual", &PyDiagram::dual)
      .def("verify", &PyDiagram::verify, "positions"_a, "weights"_a.none(), "given"_a, "progress"_a.none())
      .def("write_html", &PyDiagram::write_html, "path"_a, "positions"_a, "weights"_a.none(), "names"_a,
           "fields"_a, "progress"_a.none())
      .def("integrate", &PyDiagram::integrate, "density"_a, "given"_a, "progress"_a.none())
      .def_prop_ro("has_selection", [](const PyDiagram& d) { return d.diagram().has_selection(); })
      .def_prop_ro(
          "neighbors",
          [](const PyDiagram& d) { return d.diagram().neighbors() == Neighbors::flann ? "flann" : "tree"; })
      .def_prop_ro("timings", [](const PyDiagram& d) { return d.diagram().timings(); })
      .def_prop_ro("device", [](const PyDiagram& d) { return d.diagram().device(); })
      .def_prop_ro("precision", [](const PyDiagram& d) { return name_of(d.diagram().precision()); });

  m.def(
      "prepare",
      [](const Device& device, const Domain& domain, const nb::dict& options, nb::object progress) {
        Options with = options_of(options);
        Call call(std::move(progress));
        with.progress = [&](double fraction) { return call.report(fraction); };
        call.run([&] { prepare(device, domain, with); });
      },
      "device"_a, "domain"_a, "options"_a, "progress"_a.none());
  m.def(
      "regular_triangulation",
      [](const Device& device, const Matrix<double>& positions, const Weights& weights,
         const nb::dict& options, nb::object progress) {
        const SeedsView seeds = seeds_of(positions, weights);
        Options with = options_of(options);
        Call call(std::move(progress));
        with.progress = [&](double fraction) { return call.report(fraction); };
        return call.run([&] { return regular_triangulation(device, seeds, with); });
      },
      "device"_a, "positions"_a, "weights"_a.none(), "options"_a, "progress"_a.none());
}

}  // namespace powercell::python
