#include "lib/applications/density/pointwise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/applications/density/jump_cut.hpp"
#include "lib/applications/density/simplex_sums.hpp"

namespace powercell {
namespace {

// Integrals over walls only enter the matrix of an iteration, not its result, so their tolerance is larger
// than that of masses by this factor, within these bounds.
constexpr double wall_slack = 1e3, least_wall_tolerance = 1e-6, most_wall_tolerance = 1e-4;

// Bisections allowed beyond the last depth in one piece: a jump with corners leaves few simplices there.
constexpr int most_spare = 200;

// The part of a simplex that lies nearer to a face than all points of the last rule is at most
// 1 - (1 - 1/(9 + N))^N.
constexpr double unseen = 0.25;

/// Adaptive integration over pieces: raises the rule on each simplex until the error is within the tolerance,
/// then bisects its longest edge.
class SimplexIntegrator : public PieceIntegrator {
 public:
  SimplexIntegrator(std::unique_ptr<PointSource> source, bool linear, double tolerance,
                    const Accuracy& accuracy)
      : source_(std::move(source)),
        linear_(linear),
        jumps_(accuracy.jumps),
        cell_tolerance_(std::max(tolerance, accuracy.tolerance)),
        negligible_(accuracy.negligible_density),
        resolution_(accuracy.resolution),
        extra_depth_(accuracy.extra_depth + depth_to_reach(accuracy.resolution)) {}

  void add(const Piece& piece, Moments& moments) override {
    begin(piece, moments.origin);
    tolerance_ = cell_tolerance_;
    depth_ = (piece.solid() ? 12 : 20) + extra_depth_;
    const auto count = static_cast<std::size_t>(piece.vertex_count());
    places_.resize(count);
    for (std::size_t v = 0; v < count; ++v) places_[v] = piece.vertex(v) - origin_;
    if (piece.solid()) places_.push_back(middle_of(places_));
    set_corners();
    if (piece.solid())
      integrate<3>([&](const auto& each) { for_fan_of_solid(piece, count, each); }, moments);
    else
      integrate<2>([&](const auto& each) { for_fan(each); }, moments);
  }

  double over_face(const Piece& piece, std::uint64_t face) override {
    begin(piece, piece.vertex(piece.corner(face, 0)));
    tolerance_ = std::clamp(wall_slack * cell_tolerance_, least_wall_tolerance, most_wall_tolerance);
    depth_ = piece.solid() ? 10 : 8;
    const auto count = static_cast<std::size_t>(piece.corner_count(face));
    places_.resize(count);
    for (std::size_t k = 0; k < count; ++k) places_[k] = piece.vertex(piece.corner(face, k)) - origin_;
    set_corners();
    Moments moments;
    if (piece.solid())
      integrate<2>([&](const auto& each) { for_fan(each); }, moments);
    else
      integrate<1>([&](const auto& each) { each({corners_[0], corners_[1]}); }, moments);
    return moments.mass;
  }

 private:
  void begin(const Piece& piece, const Point& origin) {
    origin_ = origin;
    region_ = piece.region();
  }

  /// The mean of the vertices. A fan of tetrahedra from there has smaller ones, and few more, than from a
  /// vertex.
  static Point middle_of(std::span<const Point> vertices) {
    Point sum{};
    for (const Point& v : vertices)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += v[k];
    for (double& x : sum) x /= static_cast<double>(vertices.size());
    return sum;
  }

  /// The triangles of the polygon corners_.
  template <class Each>
  void for_fan(const Each& each) {
    for (std::size_t k = 2; k < corners_.size(); ++k)
      each(Simplex<2>{corners_[0], corners_[k - 1], corners_[k]});
  }

  /// The tetrahedra between the faces and the last corner, the middle of the solid.
  template <class Each>
  void for_fan_of_solid(const Piece& piece, std::size_t vertices, const Each& each) {
    const Corner& apex = corners_[vertices];
    for (std::uint64_t f = piece.first_face(); f < piece.end_face(); ++f) {
      const std::uint64_t first = piece.corner(f, 0), end = piece.corner_count(f);
      for (std::uint64_t k = 2; k < end; ++k)
        each(Simplex<3>{apex, corners_[first], corners_[piece.corner(f, k - 1)],
                        corners_[piece.corner(f, k)]});
    }
  }

  void evaluate(std::span<const Point> places, std::span<double> values) {
    at_.resize(places.size());
    for (std::size_t q = 0; q < places.size(); ++q)
      for (std::size_t k = 0; k < 3; ++k) at_[q][k] = origin_[k] + places[q][k];
    source_->evaluate(at_, region_, values);
  }

  /// Evaluates the corners at places_, which many simplices share. Affine densities do not need their values.
  void set_corners() {
    corners_.resize(places_.size());
    values_.resize(places_.size());
    if (!linear_) evaluate(places_, values_);
    for (std::size_t c = 0; c < places_.size(); ++c) corners_[c] = {places_[c], values_[c]};
  }

  /// A simplex whose estimate does not meet the tolerance, with that estimate.
  template <int N>
  struct Deferred {
    Simplex<N> simplex;
    int depth = 0;
    double size = 0;  ///< signed measure
    Sums<N> found;
    double error = 0, misfit = 0;  ///< of the rule; of values at the boundary
    double change = 0;             ///< from the rule before
    bool at_jump = false;          ///< higher rules do not converge
  };

  /// Integrates over the simplices that for_simplices(each) generates. Errors are compared with the mean
  /// density over all of them. A lower bound of it is known once each has been estimated; those that need it
  /// are refined then.
  template <int N, class ForSimplices>
  void integrate(const ForSimplices& for_simplices, Moments& moments) {
    density_floor_ = negligible_;
    spare_ = most_spare;
    std::vector<Deferred<N>> deferred;
    double size = 0, certain_mass = -moments.mass;
    for_simplices([&](const Simplex<N>& simplex) {
      size += std::abs(measure(simplex));
      add_parts<N>(simplex, 0, moments, deferred);
    });
    certain_mass += moments.mass;
    for (const Deferred<N>& one : deferred)
      certain_mass += std::abs(one.size) * std::max(0.0, one.found.mass - std::max(one.error, one.misfit));
    if (certain_mass > 0) density_floor_ = std::max(density_floor_, certain_mass / size);
    for (const Deferred<N>& one : deferred) {
      part_depth_ = one.depth;
      refine<N>(one, moments);
    }
  }

  /// Adds a simplex by the lowest rule that meets the tolerance; else defers it, or refines it if `deferred`
  /// is null.
  template <int N>
  void add_simplex(const Simplex<N>& simplex, int depth, Moments& moments,
                   std::vector<Deferred<N>>* deferred) {
    const double size = measure(simplex);
    if (size == 0) return;
    const SimplexRules& rules = simplex_rules(N);
    const Local<N> local(simplex);
    std::array<Sums<N>, SimplexRules::count> part;
    std::array<double, SimplexRules::most_points> value;
    Sums<N> last;
    double before = 0;
    for (std::size_t s = 0; s < SimplexRules::count; ++s) {
      part[s] = sum_points<N>(local, rules, s, value);
      const Sums<N> found = apply<N>(rules, s, part);
      if (linear_ && s == 1) return add_estimate(found, local, size, 0, moments);
      const double change = s == 0 ? 0 : difference<N>(found, last, local);
      if (s > 1) {
        // Changes from rule to rule shrink geometrically if they shrink; 4 is a safety factor.
        const double error = change * (before > 0 ? std::min(1.0, 4 * change / before) : 1.0);
        const LinearFit<N> fit(found, std::span(value).first(rules.size[s]));
        double misfit = fit.misfit_of_corners(simplex);
        const bool end = s + 1 == SimplexRules::count, at_jump = change > before / 2;
        const double allowed = tolerance_ * std::max(std::abs(found.mass), density_floor_);
        if (jumps_ && error <= allowed && misfit <= allowed) misfit = misfit_of_boundary<N>(local, fit);
        if (error <= allowed && misfit <= allowed) return add_estimate(found, local, size, 0, moments);
        if (end || (at_jump && depth < depth_)) {
          const Deferred<N> one{simplex, depth, size, found, error, misfit, change, at_jump};
          if (deferred) return deferred->push_back(one);
          return refine<N>(one, moments);
        }
      }
      before = change;
      last = found;
    }
  }

  template <int N>
  double misfit_of_boundary(const Local<N>& local, const LinearFit<N>& fit) {
    const std::vector<Barycentric>& points = boundary_points(N);
    values_.resize(points.size());
    evaluate_in<N>(local, points, values_);
    double most = 0;
    for (std::size_t q = 0; q < points.size(); ++q) most = std::max(most, fit.misfit(points[q], values_[q]));
    return most;
  }

  template <int N>
  void evaluate_in(const Local<N>& local, std::span<const Barycentric> points, std::span<double> values) {
    places_.resize(points.size());
    for (std::size_t q = 0; q < points.size(); ++q) {
      const Point y = local.place(points[q]);
      for (std::size_t k = 0; k < 3; ++k) places_[q][k] = local.middle[k] + y[k];
    }
    evaluate(places_, values);
  }

  /// Adds a deferred simplex if its estimate is good enough after all, if it can be cut at a jump, or if no
  /// depth is left; else bisects it.
  template <int N>
  void refine(const Deferred<N>& one, Moments& moments) {
    const double density = std::max(std::abs(one.found.mass), density_floor_), allowed = tolerance_ * density;
    const auto accept = [&](double error) {
      add_estimate(one.found, Local<N>(one.simplex), one.size, error, moments);
    };
    if (one.depth == part_depth_) part_density_ = density;
    if (one.error <= allowed && one.misfit <= allowed) return accept(0);
    if (add_cut<N>(one, moments)) return;
    if (at_end(one.depth)) return accept(std::max(one.error, unseen * one.misfit));
    const double at_jump = one.at_jump ? allowed_at_jump<N>(one.depth) : 0;
    if (one.change <= at_jump && one.misfit <= at_jump) return accept(one.change);
    if (one.depth >= depth_) --spare_;
    bisect<N>(one.simplex, one.depth, moments);
  }

  bool at_end(int depth) const { return depth >= depth_ && spare_ == 0; }

  /// Adds a simplex as parts on both sides of a jump, if that is good enough, or if no depth is left and it
  /// is better than the rule.
  template <int N>
  bool add_cut(const Deferred<N>& one, Moments& moments) {
    const Local<N> local(one.simplex);
    std::array<double, N + 1> corner;
    for (std::size_t c = 0; c <= N; ++c) corner[c] = one.simplex[c].value;
    const double allowed = allowed_at_jump<N>(one.depth);
    const auto values = [&](std::span<const Barycentric> points, std::span<double> at_points) {
      evaluate_in<N>(local, points, at_points);
    };
    const double most = at_end(one.depth) ? std::max(one.error, unseen * one.misfit) : allowed;
    if (!cut_at_jump(N, corner, values, allowed, most, cut_)) return false;
    Sums<N> found, lower;
    for (const JumpCut::Term& term : cut_.terms) {
      const Point y = local.place(term.point);
      found.add(term.mass, term.point, y);
      lower.add(term.lower, term.point, y);
    }
    const double error = cut_.error + difference<N>(found, lower, local);
    if (!(error <= most)) return false;
    moments.jump = true;
    add_estimate(found, local, one.size, error, moments);
    return true;
  }

  /// Where higher rules do not converge there is a jump or a kink: a surface that crosses 2^((N - 1) depth /
  /// N) of the 2^depth simplices. Each of these may have its share of the total error (docs/mathematics.md,
  /// below (32a)).
  template <int N>
  double allowed_at_jump(int depth) const {
    return tolerance_ * part_density_ * std::exp2(static_cast<double>(depth) / N);
  }

  /// Bisections that shorten an edge from Resolution::anywhere to Resolution::in_ball, by the count for the
  /// plane in space too: fewer suffice there, as a density in a ball needs no more simplices than one all
  /// over the domain.
  static int depth_to_reach(const Resolution& resolution) {
    constexpr double most = 20;
    if (!(resolution.radius > 0)) return 0;
    return static_cast<int>(std::min(most, 2 * std::log2(resolution.anywhere / resolution.in_ball)));
  }

  /// Whether a simplex is so small that no significant peak falls between the points of a rule.
  /// \param square  squared length of its longest edge
  template <int N>
  bool small_enough(const Simplex<N>& simplex, double square) const {
    if (square > resolution_.anywhere * resolution_.anywhere) return false;
    if (!(square > resolution_.in_ball * resolution_.in_ball)) return true;
    Point way = simplex[0].at - resolution_.center;
    for (std::size_t k = 0; k < 3; ++k) way[k] += origin_[k];
    return std::sqrt(dot(way, way)) > resolution_.radius + std::sqrt(square);
  }

  /// Adds a simplex in parts that are small enough.
  template <int N>
  void add_parts(const Simplex<N>& simplex, int depth, Moments& moments, std::vector<Deferred<N>>& deferred) {
    const SimplexEdge longest = longest_edge_of(simplex);
    if (linear_ || depth == depth_ || small_enough<N>(simplex, longest.square))
      return add_simplex<N>(simplex, depth, moments, &deferred);
    if (measure(simplex) == 0) return;
    halve<N>(simplex, longest,
             [&](const Simplex<N>& half) { add_parts<N>(half, depth + 1, moments, deferred); });
  }

  template <int N>
  void bisect(const Simplex<N>& simplex, int depth, Moments& moments) {
    halve<N>(simplex, longest_edge_of(simplex),
             [&](const Simplex<N>& half) { add_simplex<N>(half, depth + 1, moments, nullptr); });
  }

  template <int N, class Each>
  void halve(const Simplex<N>& simplex, const SimplexEdge& edge, const Each& each) {
    Corner middle;
    for (std::size_t k = 0; k < 3; ++k)
      middle.at[k] = (simplex[edge.from].at[k] + simplex[edge.to].at[k]) / 2;
    if (!linear_) evaluate({&middle.at, 1}, {&middle.value, 1});
    for (const std::size_t replaced : {edge.from, edge.to}) {
      Simplex<N> half = simplex;
      half[replaced] = middle;
      each(half);
    }
  }

  /// Sums over the points that rule s adds to the one before; appends their values to those of the earlier
  /// ones.
  template <int N>
  Sums<N> sum_points(const Local<N>& local, const SimplexRules& rules, std::size_t s,
                     std::span<double, SimplexRules::most_points> values) {
    const std::size_t begin = s == 0 ? 0 : rules.size[s - 1], count = rules.size[s] - begin;
    const Point middle{origin_[0] + local.middle[0], origin_[1] + local.middle[1],
                       origin_[2] + local.middle[2]};
    std::array<Point, SimplexRules::most_points> place, at;
    for (std::size_t q = 0; q < count; ++q) {
      const Point y = local.place(rules.point[begin + q]);
      place[q] = y;
      at[q] = {middle[0] + y[0], middle[1] + y[1], middle[2] + y[2]};
    }
    const std::span<double> value = values.subspan(begin, count);
    source_->evaluate(std::span(at).first(count), region_, value);
    Sums<N> sums;
    for (std::size_t q = 0; q < count; ++q) sums.add(value[q], rules.point[begin + q], place[q]);
    return sums;
  }

  /// Combines the sums of the points into rule s.
  template <int N>
  static Sums<N> apply(const SimplexRules& rules, std::size_t s,
                       const std::array<Sums<N>, SimplexRules::count>& part) {
    Sums<N> sums;
    for (std::size_t k = 0; k <= s; ++k) sums.add(rules.weight[s][k], part[k]);
    return sums;
  }

  template <int N>
  static void add_estimate(const Sums<N>& found, const Local<N>& local, double size, double error,
                           Moments& moments) {
    const Point first = found.first(local), &middle = local.middle;
    moments.mass += size * found.mass;
    for (std::size_t k = 0; k < 3; ++k) moments.first[k] += size * (first[k] + found.mass * middle[k]);
    moments.second += size * (found.second + 2 * dot(first, middle) + found.mass * dot(middle, middle));
    moments.error += std::abs(size) * error;
  }

  std::unique_ptr<PointSource> source_;
  bool linear_, jumps_;
  double cell_tolerance_, negligible_;
  Resolution resolution_;
  int extra_depth_;
  int part_depth_ = 0;        // depth of the deferred simplex that is being refined
  double part_density_ = 0;   // density with which its errors are compared
  int spare_ = 0;             // bisections left beyond the last depth
  double density_floor_ = 0;  // densities below count as this one when errors are compared with them
  double tolerance_ = 0;
  Point origin_{};
  std::uint32_t region_ = 0;
  int depth_ = 0;
  std::vector<Point> places_, at_;  // relative to the origin, and absolute
  std::vector<double> values_;
  std::vector<Corner> corners_;
  JumpCut cut_;
};

}  // namespace

std::unique_ptr<PieceIntegrator> PointwiseDensity::integrator(const Domain& domain,
                                                              const Accuracy& accuracy) const {
  return std::make_unique<SimplexIntegrator>(source(domain), linear(), tolerance_, accuracy);
}

}  // namespace powercell
