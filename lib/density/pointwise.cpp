#include "lib/density/pointwise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/density/simplex.hpp"
#include "lib/density/simplex_rule.hpp"

namespace powercell {
namespace {

/// A place about the seed, with the density there.
struct Corner {
  Point at{};
  double value = 0;
};

template <int N>
using Simplex = std::array<Corner, N + 1>;

double measure(const Simplex<1>& s) {
  return measure_of_segment(s[0].at, s[1].at);
}
double measure(const Simplex<2>& s) {
  return measure_of_triangle(s[0].at, s[1].at, s[2].at);
}
double measure(const Simplex<3>& s) {
  return measure_of_tetrahedron(s[0].at, s[1].at, s[2].at, s[3].at);
}

template <std::size_t Corners>
SimplexEdge longest_edge_of(const std::array<Corner, Corners>& simplex) {
  return longest_edge(Corners, [&](std::size_t c) -> const Point& { return simplex[c].at; });
}

/// Walls make the matrix of an iteration, whose result they do not change: they may be off by so much more
/// than masses, within these bounds.
constexpr double wall_slack = 1e3, least_wall_tolerance = 1e-6, most_wall_tolerance = 1e-4;

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
        cell_tolerance_(std::max(tolerance, accuracy.tolerance)),
        negligible_(accuracy.negligible_density),
        grain_(accuracy.grain),
        more_depth_(accuracy.more_depth + deeper(accuracy.grain)) {}

  void add(const Piece& piece, const Point& seed, Moments& moments) override {
    begin(piece, seed);
    tolerance_ = cell_tolerance_;
    depth_ = (piece.solid() ? 12 : 20) + more_depth_;
    const auto count = static_cast<std::size_t>(piece.vertex_count());
    places_.resize(count);
    for (std::size_t v = 0; v < count; ++v) places_[v] = minus(piece.vertex(v), seed);
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
    for (std::size_t k = 0; k < count; ++k) places_[k] = minus(piece.vertex(piece.corner(face, k)), seed_);
    set_corners();
    Moments moments;
    if (piece.solid())
      integrate<2>([&](const auto& each) { for_fan(each); }, moments);
    else
      integrate<1>([&](const auto& each) { each({corners_[0], corners_[1]}); }, moments);
    return moments.mass;
  }

 private:
  void begin(const Piece& piece, const Point& seed) {
    seed_ = seed;
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
      for (std::size_t k = 0; k < 3; ++k) at_[q][k] = seed_[k] + places[q][k];
    source_->evaluate(at_, region_, values);
  }

  /// Corners at places_, which many simplices share. What is linear does not look at them.
  void set_corners() {
    corners_.resize(places_.size());
    values_.resize(places_.size());
    if (!linear_) evaluate(places_, values_);
    for (std::size_t c = 0; c < places_.size(); ++c) corners_[c] = {places_[c], values_[c]};
  }

  /// A simplex about its middle, and what moments are compared by.
  template <int N>
  struct Local {
    Point middle{}, reach{};
    std::array<Point, N + 1> corner;
    explicit Local(const Simplex<N>& simplex) {
      for (const Corner& c : simplex)
        for (std::size_t k = 0; k < 3; ++k) middle[k] += c.at[k] / (N + 1);
      for (std::size_t c = 0; c <= N; ++c) corner[c] = minus(simplex[c].at, middle);
      for (std::size_t k = 0; k < 3; ++k) reach[k] = corner[N][k] * 2 / (N + 3);  // to rule 1's first point
    }
  };

  /// Integrals over a simplex of measure 1 about its middle, or the part of them that the points of a rule
  /// make: of the density, its moment of inertia, and the density times each barycentric coordinate.
  template <int N>
  struct Sums {
    double mass = 0, second = 0;
    std::array<double, N + 1> at_corner{};

    Point first(const Local<N>& local) const {
      Point sum{};
      for (std::size_t c = 0; c <= N; ++c)
        for (std::size_t k = 0; k < 3; ++k) sum[k] += at_corner[c] * local.corner[c][k];
      return sum;
    }
  };

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
        const double beside = misfit<N>(simplex, found, std::span(value).first(rules.size[s]));
        const bool end = s + 1 == SimplexRules::count, at_jump = change > before / 2;
        const double allowed = tolerance_ * std::max(std::abs(found.mass), floor_);
        if (left <= allowed && beside <= allowed) return take(found, local, size, 0, moments);
        if (end || (at_jump && depth < depth_)) {
          const Rest<N> rest{simplex, depth, size, found, left, beside, change, at_jump};
          if (later && depth < depth_) return later->push_back(rest);
          return finish<N>(rest, moments);
        }
      }
      before = change;
      last = found;
    }
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
    if (rest.depth == depth_) return accept(std::max(rest.left, unseen * rest.beside));
    const double at_jump = rest.at_jump ? allowed_at_jump<N>(rest.depth) : 0;
    if (rest.change <= at_jump && rest.beside <= at_jump) return accept(rest.change);
    bisect<N>(rest.simplex, rest.depth, moments);
  }

  /// Where higher rules bring nothing there is a jump or a kink, a surface that 2^((N - 1) depth / N) of the
  /// 2^depth simplices meet: each may be off by its part of what all may (docs/mathematics.md, below (32a)).
  template <int N>
  double allowed_at_jump(int depth) const {
    return tolerance_ * density_around_ * std::exp2(static_cast<double>(depth) / N);
  }

  /// Points of rules lie inside, and a jump or a kink across a corner goes between them. What they bend,
  /// their way from the linear function of the same moments (32a), goes on to the corners, where polynomials
  /// of the rules' degrees are farther from it by up to some twenty times. \return what a corner is farther
  template <int N>
  static double misfit(const Simplex<N>& simplex, const Sums<N>& found, std::span<const double> value) {
    constexpr double farther = 20;
    const SimplexRules& rules = simplex_rules(N);
    std::array<double, N + 1> linear;
    for (std::size_t c = 0; c <= N; ++c) linear[c] = (N + 1) * ((N + 2) * found.at_corner[c] - found.mass);
    double bend = 0;
    for (std::size_t q = 0; q < value.size(); ++q) {
      double fit = 0;
      for (std::size_t c = 0; c <= N; ++c) fit += rules.point[q][c] * linear[c];
      bend = std::max(bend, std::abs(value[q] - fit));
    }
    double most = 0;
    for (std::size_t c = 0; c <= N; ++c)
      most = std::max(most, std::abs(simplex[c].value - linear[c]) - farther * bend);
    return most;
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
    Point way = minus(simplex[0].at, grain_.center);
    for (std::size_t k = 0; k < 3; ++k) way[k] += seed_[k];
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
    const Point middle{seed_[0] + local.middle[0], seed_[1] + local.middle[1], seed_[2] + local.middle[2]};
    std::array<Point, SimplexRules::most_points> place, at;
    for (std::size_t q = 0; q < count; ++q) {
      Point y{};
      for (std::size_t c = 0; c <= N; ++c)
        for (std::size_t k = 0; k < 3; ++k) y[k] += rules.point[begin + q][c] * local.corner[c][k];
      place[q] = y;
      at[q] = {middle[0] + y[0], middle[1] + y[1], middle[2] + y[2]};
    }
    const std::span<double> value = values.subspan(begin, count);
    source_->evaluate(std::span(at).first(count), region_, value);
    Sums<N> sums;
    for (std::size_t q = 0; q < count; ++q) {
      sums.mass += value[q];
      for (std::size_t c = 0; c <= N; ++c) sums.at_corner[c] += value[q] * rules.point[begin + q][c];
      sums.second += value[q] * dot(place[q], place[q]);
    }
    return sums;
  }

  /// Rule s.
  template <int N>
  static Sums<N> apply(const SimplexRules& rules, std::size_t s,
                       const std::array<Sums<N>, SimplexRules::count>& part) {
    Sums<N> sums;
    for (std::size_t k = 0; k <= s; ++k) {
      const double weight = rules.weight[s][k];
      sums.mass += weight * part[k].mass;
      for (std::size_t c = 0; c <= N; ++c) sums.at_corner[c] += weight * part[k].at_corner[c];
      sums.second += weight * part[k].second;
    }
    return sums;
  }

  /// How far apart two rules are, in the unit of the mass: moments over the way from the middle to the second
  /// point.
  template <int N>
  static double difference(const Sums<N>& a, const Sums<N>& b, const Local<N>& local) {
    const Point moved = minus(a.first(local), b.first(local));
    return std::max(std::abs(a.mass - b.mass), std::sqrt(dot(moved, moved) / dot(local.reach, local.reach)));
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
  bool linear_;
  double cell_tolerance_, negligible_;
  Grain grain_;
  int more_depth_;
  int part_depth_ = 0;  // of the part that is integrated
  double tolerance_ = 0, floor_ = 0, density_around_ = 0;
  Point seed_{};
  std::uint32_t region_ = 0;
  int depth_ = 0;
  std::vector<Point> places_, at_;  // about the seed, and where that is
  std::vector<double> values_;
  std::vector<Corner> corners_;
};

}  // namespace

std::unique_ptr<PieceIntegrator> PointwiseDensity::integrator(const Domain& domain,
                                                              const Accuracy& accuracy) const {
  return std::make_unique<SimplexIntegrator>(source(domain), linear(), tolerance_, accuracy);
}

}  // namespace powercell
