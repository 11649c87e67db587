#include <powercell/point_sets.hpp>
#include <powercell/sampling.hpp>

#include "python/src/call.hpp"
#include "python/src/density.hpp"
#include "python/src/options.hpp"

namespace powercell::python {
namespace {

/// Keys: density, mode, descent, iterations, hexatic, movement, capacity_tolerance, random_seed.
SamplingOptions sampling_options(const nb::dict& given, CallSlot& slot, int dimension) {
  SamplingOptions options;
  options.density = density_of(nb::cast<nb::tuple>(given["density"]), slot, dimension);
  options.mode = chosen<SamplingMode>("mode", nb::cast<std::string>(given["mode"]),
                                      {{"blue", SamplingMode::blue}, {"quantise", SamplingMode::quantise}});
  options.descent = chosen<SamplingDescent>("descent", nb::cast<std::string>(given["descent"]),
                                            {{"auto", SamplingDescent::automatic},
                                             {"lloyd", SamplingDescent::lloyd},
                                             {"lbfgs", SamplingDescent::lbfgs}});
  options.iterations = whole<int>(given, "iterations");
  options.hexatic = nb::cast<double>(given["hexatic"]);
  options.movement = nb::cast<double>(given["movement"]);
  options.capacity_tolerance = nb::cast<double>(given["capacity_tolerance"]);
  options.random_seed = whole<std::uint64_t>(given, "random_seed");
  return options;
}

/// \param start  a number of points, or their positions
SamplingResult sample_from(const Device& device, const Domain& domain, const nb::object& start,
                           const nb::dict& given, const nb::dict& diagram, const nb::object& progress) {
  CallSlot slot;
  SamplingOptions options = sampling_options(given, slot, domain.dimension());
  options.diagram = options_of(diagram);
  options.diagram.progress = [&](double) { return slot.check(); };
  options.progress = [&](const SamplingStep& step) { return slot.report(step); };
  if (nb::isinstance<nb::int_>(start)) {
    const auto n = nb::cast<std::size_t>(start);
    return slot.run(progress, [&] { return sample(device, domain, n, options); });
  }
  const auto positions = nb::cast<Matrix<double>>(start);
  const std::span all = span_of(positions);
  return slot.run(progress, [&] { return sample(device, domain, all, options); });
}

}  // namespace

void bind_sampling(nb::module_& m) {
  nb::class_<SamplingStep>(m, "SamplingStep", "State after one iteration, which moves all points.")
      .def_ro("iteration", &SamplingStep::iteration)
      .def_ro("energy", &SamplingStep::energy)
      .def_ro("gradient", &SamplingStep::gradient)
      .def_ro("hexatic", &SamplingStep::hexatic)
      .def_ro("capacity_error", &SamplingStep::capacity_error)
      .def_ro("newton_steps", &SamplingStep::newton_steps)
      .def_ro("seconds", &SamplingStep::seconds);
  nb::class_<PartsApart>(m, "PartsApart",
                         R"(Parts of cells that are not connected with the part that has the point.

Attributes
----------
cells : int
    Cells with such parts.
share : float
    Of the domain's area or volume in such parts.
distance : float
    Of such a part's centroid from the part with the point, the median by area or volume; 0 without such parts.)")
      .def_ro("cells", &PartsApart::cells)
      .def_ro("share", &PartsApart::share)
      .def_ro("distance", &PartsApart::distance);
  nb::class_<SamplingResult>(m, "SamplingResult", "Points whose cells have equal masses.")
      .def_ro("converged", &SamplingResult::converged)
      .def_prop_ro("positions",
                   [](nb::handle self) {
                     const SamplingResult& r = nb::cast<SamplingResult&>(self);
                     return rows(r.positions, r.mass.empty() ? 0 : r.positions.size() / r.mass.size(), self);
                   })
      .def_prop_ro("weights",
                   [](nb::handle self) { return view(nb::cast<SamplingResult&>(self).weights, self); })
      .def_prop_ro("mass", [](nb::handle self) { return view(nb::cast<SamplingResult&>(self).mass, self); })
      .def_ro("capacity_error", &SamplingResult::capacity_error)
      .def_ro("quadrature_error", &SamplingResult::quadrature_error)
      .def_ro("energy", &SamplingResult::energy)
      .def_ro("relative_energy", &SamplingResult::relative_energy)
      .def_ro("layers", &SamplingResult::layers)
      .def_ro("layer_spacing", &SamplingResult::layer_spacing)
      .def_ro("apart", &SamplingResult::apart)
      .def_ro("steps", &SamplingResult::steps);
  m.def("sample", &sample_from, "device"_a, "domain"_a, "start"_a, "given"_a, "diagram"_a,
        "progress"_a.none());
}

}  // namespace powercell::python
