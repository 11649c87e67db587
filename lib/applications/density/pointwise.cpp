#include "lib/applications/density/pointwise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/applications/density/jump_cut.hpp"
#include "lib/applications/density/simplex_sums.hpp"

namespace powercell {
namespace {

/// Walls make the matrix of an iteration, whose result they do not change: they may be off by so much more
/// than masses, within these bounds.
constexpr double wall_slack = 1e3, least_wall_tolerance = 1e-6, most_wall_tolerance = 1e-4;

/// Where jumps have corners few simplices are left at the last depth, and are halved on: in one piece as
/// many.
constexpr int most_spare = 200;

/// What of a simplex lies nearer to a face than all points of the last rule, at most: 1 - (1 - 1/(9 + N))^N.
constexpr double unseen = 0.25;

/// Integrates by the rules of a simplex, going to the next until the error is within the tolerance, and then
/// bisecting the longest edge.
class SimplexIntegrator : public PieceIntegrator {
 public:
  SimplexIntegrator(std::unique_ptr<PointSource> source, bool linear, double tolerance,
                    const Accuracy& accuracy)
      : source_(std::move(source)),
        linear_(linear),
        jumps_(accuracy.jumps),
        cell_tolerance_(std::max(tolerance, accuracy.tolerance)),
        negligible_(accuracy.negligible_density),
        grain_(accuracy.grain),
        more_depth_(accuracy.more_depth + deeper(accuracy.grain)) {}

  void add(const Piece& piece, Moments& moments) override {
    begin(piece, moments.origin);
    tolerance_ = cell_tolerance_;
    depth_ = (piece.solid() ? 12 : 20) + more_depth_;
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

  /// The mean of the vertices: tetrahedra from there are smaller than those from a vertex, and few more.
  static Point middle_of(std::span<const Point> vertices) {
    Point sum{};
    for (const Point& v : vertices)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += v[k];
    for (double& x : sum) x /= static_cast<double>(vertices.size());
    return sum;
  }

  /// The triangles of the polygon of corners_.
  template <class Each>
  void for_fan(const Each& each) {
    for (std::size_t k = 2; k < corners_.size(); ++k)
      each(Simplex<2>{corners_[0], corners_[k - 1], corners_[k]});
  }

  /// The tetrahedra between the faces and the corner behind the vertices.
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

  /// Corners at places_, which many simplices share. What is linear does not look at them.
  void set_corners() {
    corners_.resize(places_.size());
    values_.resize(places_.size());
    if (!linear_) evaluate(places_, values_);
    for (std::size_t c = 0; c < places_.size(); ++c) corners_[c] = {places_[c], values_[c]};
  }

  /// A part whose estimate is not good enough by itself.
  template <int N>
  struct Rest {
    Simplex<N> simplex;
    int depth = 0;
    double size = 0;
    Sums<N> found;
    double left = 0, beside = 0, change = 0;
    bool at_jump = false;
  };

  /// Simplices that for_simplices(each) makes. Errors count beside the mean density over all of them: what
  /// is sure of that is known when each has been looked at once, and then parts are refined that need it.
  template <int N, class ForSimplices>
  void integrate(const ForSimplices& for_simplices, Moments& moments) {
    floor_ = negligible_;
    spare_ = most_spare;
    std::vector<Rest<N>> rests;
    double size = 0, sure = -moments.mass;
    for_simplices([&](const Simplex<N>& simplex) {
      size += std::abs(measure(simplex));
      add_parts<N>(simplex, 0, moments, rests);
    });
    sure += moments.mass;
    for (const Rest<N>& rest : rests)
      sure += std::abs(rest.size) * std::max(0.0, rest.found.mass - std::max(rest.left, rest.beside));
    if (sure > 0) floor_ = std::max(floor_, sure / size);
    for (const Rest<N>& rest : rests) {
      part_depth_ = rest.depth;
      finish<N>(rest, moments);
    }
  }

  template <int N>
  void add_simplex(const Simplex<N>& simplex, int depth, Moments& moments, std::vector<Rest<N>>* later) {
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
      if (linear_ && s == 1) return take(found, local, size, 0, moments);
      const double change = s == 0 ? 0 : difference<N>(found, last, local);
      if (s > 1) {
        // Where changes shrink they go on shrinking; a factor of 4 is for safety.
        const double left = change * (before > 0 ? std::min(1.0, 4 * change / before) : 1.0);
        const LinearFit<N> fit(found, std::span(value).first(rules.size[s]));
        double beside = fit.misfit_of_corners(simplex);
        const bool end = s + 1 == SimplexRules::count, at_jump = change > before / 2;
        const double allowed = tolerance_ * std::max(std::abs(found.mass), floor_);
        if (jumps_ && left <= allowed && beside <= allowed) beside = misfit_of_boundary<N>(local, fit);
        if (left <= allowed && beside <= allowed) return take(found, local, size, 0, moments);
        if (end || (at_jump && depth < depth_)) {
          const Rest<N> rest{simplex, depth, size, found, left, beside, change, at_jump};
          if (later) return later->push_back(rest);
          return finish<N>(rest, moments);
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

  /// Takes what is good enough, and what has no depth left; halves others.
  template <int N>
  void finish(const Rest<N>& rest, Moments& moments) {
    const double density = std::max(std::abs(rest.found.mass), floor_), allowed = tolerance_ * density;
    const auto accept = [&](double error) {
      take(rest.found, Local<N>(rest.simplex), rest.size, error, moments);
    };
    if (rest.depth == part_depth_) density_around_ = density;
    if (rest.left <= allowed && rest.beside <= allowed) return accept(0);
    if (take_cut<N>(rest, moments)) return;
    if (at_end(rest.depth)) return accept(std::max(rest.left, unseen * rest.beside));
    const double at_jump = rest.at_jump ? allowed_at_jump<N>(rest.depth) : 0;
    if (rest.change <= at_jump && rest.beside <= at_jump) return accept(rest.change);
    if (rest.depth >= depth_) --spare_;
    bisect<N>(rest.simplex, rest.depth, moments);
  }

  bool at_end(int depth) const { return depth >= depth_ && spare_ == 0; }

  /// Takes a simplex in the parts on both sides of a jump, if that is good enough, or better than what else
  /// there is where no depth is left.
  template <int N>
  bool take_cut(const Rest<N>& rest, Moments& moments) {
    const Local<N> local(rest.simplex);
    std::array<double, N + 1> corner;
    for (std::size_t c = 0; c <= N; ++c) corner[c] = rest.simplex[c].value;
    const double allowed = allowed_at_jump<N>(rest.depth);
    const auto values = [&](std::span<const Barycentric> points, std::span<double> at_points) {
      evaluate_in<N>(local, points, at_points);
    };
    const double most = at_end(rest.depth) ? std::max(rest.left, unseen * rest.beside) : allowed;
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
    take(found, local, rest.size, error, moments);
    return true;
  }

  /// Where higher rules bring nothing there is a jump or a kink, a surface that 2^((N - 1) depth / N) of the
  /// 2^depth simplices meet: each may be off by its part of what all may (docs/mathematics.md, below (32a)).
  template <int N>
  double allowed_at_jump(int depth) const {
    return tolerance_ * density_around_ * std::exp2(static_cast<double>(depth) / N);
  }

  /// Bisections that take an edge of the domain's grain to that of where the density is, in space as in the
  /// plane: fewer than there would be, and no more simplices than a density all over the domain has.
  static int deeper(const Grain& grain) {
    constexpr double most = 20;
    return grain.radius > 0 ? static_cast<int>(std::min(most, 2 * std::log2(grain.anywhere / grain.dense)))
                            : 0;
  }

  /// Whether no peak worth telling falls between the points of a rule.
  template <int N>
  bool small_enough(const Simplex<N>& simplex, double square) const {
    if (square > grain_.anywhere * grain_.anywhere) return false;
    if (!(square > grain_.dense * grain_.dense)) return true;
    Point way = simplex[0].at - grain_.center;
    for (std::size_t k = 0; k < 3; ++k) way[k] += origin_[k];
    return std::sqrt(dot(way, way)) > grain_.radius + std::sqrt(square);
  }

  /// A simplex in parts that are small enough.
  template <int N>
  void add_parts(const Simplex<N>& simplex, int depth, Moments& moments, std::vector<Rest<N>>& rests) {
    const SimplexEdge longest = longest_edge_of(simplex);
    if (linear_ || depth == depth_ || small_enough<N>(simplex, longest.square))
      return add_simplex<N>(simplex, depth, moments, &rests);
    if (measure(simplex) == 0) return;
    halve<N>(simplex, longest,
             [&](const Simplex<N>& half) { add_parts<N>(half, depth + 1, moments, rests); });
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

  /// Sums over the points that rule s adds to the one before, whose values go behind those of the latter.
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

  /// Rule s.
  template <int N>
  static Sums<N> apply(const SimplexRules& rules, std::size_t s,
                       const std::array<Sums<N>, SimplexRules::count>& part) {
    Sums<N> sums;
    for (std::size_t k = 0; k <= s; ++k) sums.add(rules.weight[s][k], part[k]);
    return sums;
  }

  template <int N>
  static void take(const Sums<N>& found, const Local<N>& local, double size, double error, Moments& moments) {
    const Point first = found.first(local), &middle = local.middle;
    moments.mass += size * found.mass;
    for (std::size_t k = 0; k < 3; ++k) moments.first[k] += size * (first[k] + found.mass * middle[k]);
    moments.second += size * (found.second + 2 * dot(first, middle) + found.mass * dot(middle, middle));
    moments.error += std::abs(size) * error;
  }

  std::unique_ptr<PointSource> source_;
  bool linear_, jumps_;
  double cell_tolerance_, negligible_;
  Grain grain_;
  int more_depth_;
  int part_depth_ = 0;  // of the part that is integrated
  int spare_ = 0;       // simplices that may still be halved beyond the last depth
  double tolerance_ = 0, floor_ = 0, density_around_ = 0;
  Point origin_{};
  std::uint32_t region_ = 0;
  int depth_ = 0;
  std::vector<Point> places_, at_;  // about the origin, and where that is
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
