#include <powercell/transport.hpp>

#include "python/src/call.hpp"
#include "python/src/density.hpp"
#include "python/src/options.hpp"
#include "python/src/seeds.hpp"

namespace powercell::python {
namespace {

class PySolver {
 public:
  PySolver(const Device& device, const Domain& domain, const nb::dict& given, const nb::dict& options)
      : solver_(device, domain, transport_options(domain, given, options)) {}

  void set_seeds(const Matrix<double>& positions, const Weights& weights) {
    const SeedsView seeds = seeds_of(positions, weights);
    slot_.run(nb::none(), [&] { solver_.set_seeds(seeds); });
  }
  void move_seeds(const Matrix<double>& positions) {
    const std::span all = span_of(positions);
    slot_.run(nb::none(), [&] { solver_.move_seeds(all); });
  }
  void set_weights(const Vector<double>& weights) {
    const std::span all = span_of(weights);
    slot_.run(nb::none(), [&] { solver_.set_weights(all); });
  }
  void set_masses(const Weights& masses) {
    const std::span all = masses ? span_of(*masses) : std::span<const double>();
    slot_.run(nb::none(), [&] { solver_.set_masses(all); });
  }
  void set_tolerance(double tolerance) {
    slot_.run(nb::none(), [&] { solver_.set_tolerance(tolerance); });
  }
  void set_max_steps(int steps) {
    slot_.run(nb::none(), [&] { solver_.set_max_steps(steps); });
  }
  /// \param progress  None, or a function of a TransportStep
  TransportResult solve(nb::object progress) {
    return slot_.run(std::move(progress), [&] { return solver_.solve(); });
  }
  /// Positions and weights of the diagram of the last solve.
  nb::tuple diagram_seeds() {
    std::size_t n = 0;
    std::vector<double> positions, weights;
    slot_.run(nb::none(), [&] {
      const Diagram& diagram = solver_.diagram();
      n = diagram.size();
      positions = diagram.positions();
      weights = solver_.result().weights;
    });
    const std::size_t d = positions.size() / n;
    return nb::make_tuple(owned(std::move(positions), {n, d}), owned(std::move(weights), {n}));
  }

 private:
  TransportOptions transport_options(const Domain& domain, const nb::dict& given, const nb::dict& options) {
    TransportOptions result;
    result.density = density_of(nb::cast<nb::tuple>(given["density"]), slot_, domain.dimension());
    result.tolerance = nb::cast<double>(given["tolerance"]);
    result.max_steps = whole<int>(given, "max_steps");
    result.rescale = nb::cast<bool>(given["rescale"]);
    result.linear = chosen<LinearSolver>("linear", nb::cast<std::string>(given["linear"]),
                                         {{"auto", LinearSolver::automatic},
                                          {"dense", LinearSolver::dense},
                                          {"direct", LinearSolver::direct},
                                          {"multilevel", LinearSolver::multilevel}});
    result.linear_residual = nb::cast<double>(given["linear_residual"]);
    result.diagram = options_of(options);
    result.diagram.progress = [this](double) { return slot_.check(); };
    result.progress = [this](const TransportStep& step) { return slot_.report(step); };
    return result;
  }

  CallSlot slot_;
  TransportSolver solver_;
};

#define POWERCELL_VECTOR(member) \
  def_prop_ro(#member, [](nb::handle self) { return view(nb::cast<TransportResult&>(self).member, self); })

}  // namespace

void bind_transport(nb::module_& m) {
  nb::class_<TransportStep>(m, "TransportStep", "One accepted step of the solver.")
      .def_ro("step", &TransportStep::step)
      .def_prop_ro("phase", [](const TransportStep& s) { return name(s.phase); })
      .def_ro("exponent", &TransportStep::exponent)
      .def_ro("spread", &TransportStep::spread)
      .def_ro("error", &TransportStep::error)
      .def_ro("gradient", &TransportStep::gradient)
      .def_ro("least", &TransportStep::least)
      .def_ro("empty", &TransportStep::empty)
      .def_ro("dual", &TransportStep::dual)
      .def_ro("length", &TransportStep::length)
      .def_ro("diagrams", &TransportStep::diagrams)
      .def_prop_ro("linear", [](const TransportStep& s) { return name(s.linear); })
      .def_ro("linear_iterations", &TransportStep::linear_iterations)
      .def_ro("linear_residual", &TransportStep::linear_residual)
      .def_ro("diagram_seconds", &TransportStep::diagram_seconds)
      .def_ro("linear_seconds", &TransportStep::linear_seconds);
  nb::class_<TransportResult>(m, "TransportResult",
                              "The result of a transport; arrays have the order of the seeds.")
      .def_ro("converged", &TransportResult::converged)
      .def_ro("error", &TransportResult::error)
      .def_ro("quadrature_error", &TransportResult::quadrature_error)
      .def_ro("rounding_error", &TransportResult::rounding_error)
      .def_ro("tolerance", &TransportResult::tolerance)
      .POWERCELL_VECTOR(weights)
      .POWERCELL_VECTOR(target)
      .POWERCELL_VECTOR(mass)
      .def_prop_ro("centroid",
                   [](nb::handle self) {
                     const TransportResult& r = nb::cast<TransportResult&>(self);
                     return rows(r.centroid, r.mass.empty() ? 0 : r.centroid.size() / r.mass.size(), self);
                   })
      .POWERCELL_VECTOR(second_moment)
      .POWERCELL_VECTOR(merged_with)
      .def_ro("merged", &TransportResult::merged)
      .def_ro("total_mass", &TransportResult::total_mass)
      .def_ro("cost", &TransportResult::primal,
              "W2 squared, once converged: the cost of moving the masses to their seeds.")
      .def_ro("dual", &TransportResult::dual)
      .def_ro("steps", &TransportResult::steps)
      .def_ro("diagrams", &TransportResult::diagrams)
      .def_prop_ro("newton_steps", &TransportResult::newton_steps);
  nb::class_<PySolver>(m, "TransportSolver")
      .def(nb::init<const Device&, const Domain&, const nb::dict&, const nb::dict&>())
      .def("set_seeds", &PySolver::set_seeds, "positions"_a, "weights"_a.none())
      .def("move_seeds", &PySolver::move_seeds)
      .def("set_weights", &PySolver::set_weights)
      .def("set_masses", &PySolver::set_masses, "masses"_a.none())
      .def("set_tolerance", &PySolver::set_tolerance)
      .def("set_max_steps", &PySolver::set_max_steps)
      .def("diagram_seeds", &PySolver::diagram_seeds)
      .def("solve", &PySolver::solve, "progress"_a.none());
}

}  // namespace powercell::python
