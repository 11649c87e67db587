#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <powercell/point_sets.hpp>

#include "lib/applications/sampling/even_points.hpp"
#include "lib/applications/sampling/lbfgs.hpp"
#include "lib/applications/sampling/moved_layers.hpp"
#include "lib/applications/sampling/state.hpp"
#include "lib/base/float_environment.hpp"
#include "lib/base/work_clock.hpp"

namespace powercell {
namespace {

// Tolerances of the capacities while points still move; the last solve has the caller's. For Lloyd's method
// 0.1 costs energy in the end, and less than 0.03 gains nothing while points move far.
constexpr double lloyd_tolerance = 3e-2, lbfgs_tolerance = 1e-5;
// Centroids of cells whose masses are off by 1 % are off by about 1 % of the spacing. To come to rest, points
// need a tolerance below this fraction of their mean move relative to the spacing.
constexpr double tolerance_of_move = 0.3;
// Newton steps of the transport: as in TransportOptions, and for a move of blue noise. These take one or two,
// and many only if mass has to cross gaps, as between the strokes of a drawing; the last solve makes up for
// masses that are not equal until then.
constexpr int most_newton_steps = 500, most_newton_steps_of_move = 8;
// Blue noise in the plane also stops when the hexatic order has risen by less than this over so many moves:
// points along strokes have few neighbours, and a low order whatever the number of moves.
constexpr double least_rise = 0.01;
constexpr std::size_t moves_of_rise = 10;
constexpr double sufficient_decrease = 1e-4;  // of the energy, relative to the slope (Armijo)
constexpr int most_halvings = 10;             // of a step
// Iterations of blue noise where the hexatic order is not meaningful: points in the plane have six neighbours
// on average, and fewer if most are at the boundary, as in a row. The order of few points is not meaningful
// either.
constexpr int iterations_without_order = 20;
constexpr double neighbours_with_order = 5;
constexpr std::size_t points_with_order = 50;
// Between layers, in units of the spacing: so far that a cell which has its share on one of them reaches no
// other.
constexpr double gap_of_layers = 4;

/// Random points whose numbers in parts of the domain that are apart are near their shares.
std::vector<double> spread_points(const Domain& domain, const SamplingOptions& options, std::size_t n) {
  return even_points(random_points(domain, options.density, points_to_choose_from * n, options.random_seed),
                     static_cast<std::size_t>(domain.dimension()), n);
}

class Sampler {
 public:
  Sampler(const Device& device, const Domain& domain, const SamplingOptions& options,
          std::vector<double> positions, bool drawn)
      : domain_(domain),
        options_(options),
        drawn_(drawn),
        lloyd_(options.descent == SamplingDescent::lloyd ||
               (options.descent == SamplingDescent::automatic && options.mode == SamplingMode::blue)),
        until_hexatic_(options.mode == SamplingMode::blue && domain.dimension() == 2),
        fixed_count_(options.mode == SamplingMode::blue ? !until_hexatic_ || options.iterations == 0
                                                        : options.movement == 0),
        start_(std::move(positions)),
        state_(device, domain, options, start_),
        spacing_(
            std::pow(domain.measure() / static_cast<double>(state_.size()), 1.0 / domain.cell_dimension())) {}

  /// Moves the points as far as the mode demands.
  /// \return the points, in the domain
  std::vector<double> move() {
    const int most = iterations();
    state_.move_to(start_, tolerance(), most_steps());
    if (drawn_ && options_.mode == SamplingMode::blue && !state_.cells().converged) start_evenly();
    refuse_duplicates();
    record(0);
    while (!at_end() && result_.steps.back().iteration < most) {
      const int iteration = result_.steps.back().iteration + 1;
      if (lloyd_) {
        state_.move_to(state_.centroids(), tolerance(), most_steps());
      } else if (!lbfgs_move()) {
        no_descent_left_ = true;
        break;
      }
      record(iteration);
    }
    const int iterations_done = result_.steps.back().iteration;
    done_ = at_end() || no_descent_left_ || (fixed_count_ && iterations_done == most);
    const bool at_centroids = iterations_done > 0 && lloyd_;
    return state_.on_density(state_.in_domain(at_centroids));
  }

  SamplingResult run() {
    std::vector<double> positions = move();
    return finish(state_, std::move(positions));
  }

  /// The result for the points of move(), with cells of a state whose domain may be another one.
  SamplingResult finish(SamplingState& state, std::vector<double> positions) {
    state.move_to(std::move(positions), options_.capacity_tolerance, most_newton_steps);
    const TransportResult& cells = state.cells();
    result_.converged = done_ && cells.converged && cells.merged == 0;
    result_.positions = state.wrapped();
    result_.weights = cells.weights;
    result_.mass = cells.mass;
    result_.capacity_error = state.capacity_error();
    result_.quadrature_error = cells.quadrature_error;
    result_.energy = cells.primal;
    result_.relative_energy = state.relative_energy();
    result_.apart = state.parts_apart();
    return std::move(result_);
  }

 private:
  int iterations() const {
    if (options_.iterations > 0) return options_.iterations;
    if (options_.mode == SamplingMode::quantise) return 10000;
    return until_hexatic_ ? 100 : iterations_without_order;
  }

  double tolerance() const {
    if (!lloyd_) return lbfgs_tolerance;
    if (options_.mode == SamplingMode::blue || result_.steps.empty()) return lloyd_tolerance;
    return std::clamp(tolerance_of_move * result_.steps.back().gradient / spacing_, lbfgs_tolerance,
                      lloyd_tolerance);
  }

  int most_steps() const {
    return options_.mode == SamplingMode::blue ? most_newton_steps_of_move : most_newton_steps;
  }

  /// Starts from points whose numbers in the parts of the density are near their shares: mass that has to
  /// cross gaps costs many Newton steps.
  void start_evenly() {
    const std::size_t n = state_.size();
    start_ = spread_points(domain_, options_, n);
    state_.restart(start_);
    state_.move_to(start_, tolerance(), most_steps());
  }

  /// Whether the hexatic order, which grows as points become even, no longer does.
  bool order_rests() const {
    const std::size_t last = result_.steps.size() - 1;
    return last >= 2 * moves_of_rise &&
           result_.steps[last].hexatic < result_.steps[last - moves_of_rise].hexatic + least_rise;
  }

  bool at_end() const {
    const SamplingStep& step = result_.steps.back();
    const bool at_rest = step.gradient <= options_.movement * spacing_;
    if (!until_hexatic_) return options_.mode == SamplingMode::quantise && at_rest;
    if (step.iteration == 0) return false;  // initial points may meet the criterion by chance
    if (at_rest) return true;
    if (neighbours_ >= neighbours_with_order && state_.size() >= points_with_order)
      return step.hexatic >= options_.hexatic || order_rests();
    return step.iteration >= std::min(iterations_without_order, iterations());
  }

  void record(int iteration) {
    SamplingStep step;
    step.iteration = iteration;
    step.energy = state_.energy();
    step.gradient = state_.distance_to_centroids();
    step.hexatic = std::numeric_limits<double>::quiet_NaN();
    if (until_hexatic_) {
      const NeighbourStatistics found = state_.neighbour_statistics();
      step.hexatic = found.spacing.hexatic;
      neighbours_ = found.neighbours;
    }
    step.capacity_error = state_.capacity_error();
    step.newton_steps = static_cast<int>(state_.cells().newton_steps());
    step.seconds = clock_.lap();
    result_.steps.push_back(step);
    if (options_.progress && !options_.progress(step))
      throw Error(ErrorCode::interrupted, "stopped by the progress callback");
  }

  /// Points at the same position would stay together.
  /// \throw Error invalid_argument
  void refuse_duplicates() const {
    const std::vector<std::uint32_t>& first = state_.cells().merged_with;
    for (std::size_t i = 0; i < first.size(); ++i)
      if (first[i] != i)
        throw Error(ErrorCode::invalid_argument,
                    "points " + std::to_string(first[i]) + " and " + std::to_string(i) +
                        " are at the same position, so they cannot have cells of their own");
  }

  /// One step with backtracking.
  /// \return false if no step along the gradient decreases the energy either
  bool lbfgs_move() {
    const std::vector<double> from = state_.positions(), gradient = state_.energy_gradient();
    const double energy = state_.energy();
    std::vector<double> inverse_diagonal(from.size());
    for (std::size_t k = 0; k < from.size(); ++k)
      inverse_diagonal[k] = 1 / (2 * state_.cells().mass[k / state_.dimension()]);
    for (;;) {
      const std::vector<double> direction = memory_.direction(gradient, inverse_diagonal);
      const double slope = std::inner_product(gradient.begin(), gradient.end(), direction.begin(), 0.0);
      double length = 1;
      for (int k = 0; slope < 0 && k < most_halvings; ++k, length /= 2) {
        std::vector<double> step = direction, to = from;
        for (std::size_t c = 0; c < to.size(); ++c) to[c] += step[c] *= length;
        state_.move_to(std::move(to), tolerance(), most_steps());
        if (!(state_.energy() <= energy + sufficient_decrease * length * slope)) continue;
        std::vector<double> change = state_.energy_gradient();
        for (std::size_t c = 0; c < change.size(); ++c) change[c] -= gradient[c];
        memory_.add(std::move(step), std::move(change));
        return true;
      }
      const bool was_plain = memory_.empty();
      memory_.forget();
      if (was_plain) {
        state_.move_to(from, tolerance(), most_steps());
        return false;
      }
    }
  }

  const Domain& domain_;
  const SamplingOptions& options_;
  bool drawn_;          // the initial points are random
  bool lloyd_;          // the descent
  bool until_hexatic_;  // the criterion is the hexatic order
  bool fixed_count_;    // the criterion is the number of iterations
  std::vector<double> start_;
  SamplingState state_;
  double spacing_;
  LbfgsMemory memory_;
  double neighbours_ = 0;         // per point on average, after the last iteration of blue in the plane
  bool no_descent_left_ = false;  // the points rest as well as rounding allows
  bool done_ = false;             // the mode's criterion is met
  SamplingResult result_;
  WorkClock clock_;
};

void check(const SamplingOptions& options) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorCode::invalid_argument, what); };
  if (options.iterations < 0) refuse("the number of iterations is negative");
  if (!(options.hexatic > 0 && options.hexatic < 1))
    refuse("the hexatic order to stop at must be between 0 and 1");
  if (!(options.movement >= 0)) refuse("the movement to stop at must not be negative");
  if (!(options.capacity_tolerance > 0 && options.capacity_tolerance < 1))
    refuse("the tolerance of the capacities must be between 0 and 1");
}

/// Blue noise on the layers of a surface.
SamplingResult sample_layers(const Device& device, const Domain& surface, std::size_t n,
                             const SamplingOptions& options, const Layers& layers) {
  const MovedLayers apart(surface, layers,
                          gap_of_layers * std::sqrt(surface.measure() / static_cast<double>(n)));
  SamplingOptions moved = options;
  moved.density = apart.density(options.density);
  Sampler sampler(device, apart.domain(), moved, spread_points(apart.domain(), moved, n), false);
  std::vector<double> positions = sampler.move();
  const Spacing spacing = neighbour_statistics(device, apart.domain(), positions, false,
                                               options.density.is_constant(), options.diagram)
                              .spacing;
  const std::vector<std::size_t> points = apart.move_back(positions);
  SamplingState state(device, surface, options, positions);
  SamplingResult result = sampler.finish(state, std::move(positions));
  result.layers = points;
  result.layer_spacing = spacing;
  return result;
}

}  // namespace

SamplingResult sample(const Device& device, const Domain& domain, std::size_t n,
                      const SamplingOptions& options) {
  const FloatEnvironment environment;
  check(options);
  if (n == 0) throw Error(ErrorCode::invalid_argument, "no points: sampling needs at least one");
  if (domain.kind() == DomainKind::surface && options.mode == SamplingMode::blue) {
    const Layers layers =
        find_layers(domain, options.density, n, options.random_seed, options.diagram.threads);
    if (layers.count > 1) return sample_layers(device, domain, n, options, layers);
  }
  return Sampler(device, domain, options, random_points(domain, options.density, n, options.random_seed),
                 true)
      .run();
}

SamplingResult sample(const Device& device, const Domain& domain, std::span<const double> positions,
                      const SamplingOptions& options) {
  const FloatEnvironment environment;
  check(options);
  if (positions.empty() || positions.size() % static_cast<std::size_t>(domain.dimension()) != 0)
    throw Error(ErrorCode::invalid_argument, std::to_string(positions.size()) +
                                                 " coordinates are not a whole number of points with " +
                                                 std::to_string(domain.dimension()) + " each");
  return Sampler(device, domain, options, {positions.begin(), positions.end()}, false).run();
}

}  // namespace powercell
