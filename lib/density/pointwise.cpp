#include "lib/density/pointwise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

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
  const Point e = minus(s[1].at, s[0].at);
  return std::sqrt(dot(e, e));
}
double measure(const Simplex<2>& s) {
  const Point normal = cross(minus(s[1].at, s[0].at), minus(s[2].at, s[0].at));
  return std::sqrt(dot(normal, normal)) / 2;
}
/// Signed: fans of solids that rounding has bent cancel.
double measure(const Simplex<3>& s) {
  return dot(minus(s[1].at, s[0].at), cross(minus(s[2].at, s[0].at), minus(s[3].at, s[0].at))) / 6;
}

/// Walls make the matrix of an iteration, whose result they do not change: they may be off by so much more
/// than masses, within these bounds.
constexpr double wall_slack = 1e3, least_wall_tolerance = 1e-6, most_wall_tolerance = 1e-4;

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
        least_depth_(accuracy.least_depth),
        more_depth_(accuracy.more_depth) {}

  void add(const Piece& piece, const Point& seed, Moments& moments) override {
    begin(piece, seed);
    tolerance_ = cell_tolerance_;
    depth_ = (piece.solid() ? 12 : 20) + more_depth_;
    const auto count = static_cast<std::size_t>(piece.vertex_count());
    places_.resize(count);
    for (std::size_t v = 0; v < count; ++v) places_[v] = minus(piece.vertex(v), seed);
    if (piece.solid()) places_.push_back(middle_of(places_));
    set_corners();
    if (!piece.solid()) {
      for (std::size_t k = 2; k < count; ++k)
        add_simplex<2>({corners_[0], corners_[k - 1], corners_[k]}, 0, moments);
      return;
    }
    const Corner& apex = corners_[count];
    for (std::uint64_t f = piece.first_face(); f < piece.end_face(); ++f) {
      const std::uint64_t first = piece.corner(f, 0), end = piece.corner_count(f);
      for (std::uint64_t k = 2; k < end; ++k)
        add_simplex<3>(
            {apex, corners_[first], corners_[piece.corner(f, k - 1)], corners_[piece.corner(f, k)]}, 0,
            moments);
    }
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
    if (!piece.solid()) {
      add_simplex<1>({corners_[0], corners_[1]}, 0, moments);
      return moments.mass;
    }
    for (std::size_t k = 2; k < count; ++k)
      add_simplex<2>({corners_[0], corners_[k - 1], corners_[k]}, 0, moments);
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
  /// make.
  struct Sums {
    double mass = 0, second = 0;
    Point first{};
  };

  template <int N>
  void add_simplex(const Simplex<N>& simplex, int depth, Moments& moments) {
    const double size = measure(simplex);
    if (size == 0) return;
    if (depth < least_depth_) return bisect<N>(simplex, depth, moments);
    const SimplexRules& rules = simplex_rules(N);
    const Local<N> local(simplex);
    std::array<Sums, SimplexRules::count> part;
    Range range;
    Sums last;
    double before = 0;
    for (std::size_t s = 0; s < SimplexRules::count; ++s) {
      part[s] = sum_points<N>(local, rules, s, range);
      const Sums found = apply(rules, s, part);
      if (linear_ && s == 1) return take(found, local.middle, size, 0, moments);
      const double change = s == 0 ? 0 : difference<N>(found, last, local);
      if (s > 1) {
        // Where changes shrink they go on shrinking; a factor of 4 is for safety.
        const double left = change * (before > 0 ? std::min(1.0, 4 * change / before) : 1.0);
        const double allowed = tolerance_ * std::max(std::abs(found.mass), negligible_);
        const bool end = s + 1 == SimplexRules::count;
        const bool good = left <= allowed && corners_fit<N>(simplex, range, allowed);
        if (good || (end && depth == depth_))
          return take(found, local.middle, size, good ? 0 : left, moments);
      }
      before = change;
      last = found;
    }
    bisect<N>(simplex, depth, moments);
  }

  struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void see(double value) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  };

  /// Points of rules lie inside, so a jump across a corner goes between them. Next to a smooth extremum the
  /// values at corners are farther out than those at the points by up to twice the range of these.
  template <int N>
  static bool corners_fit(const Simplex<N>& simplex, const Range& range, double allowed) {
    const double margin = 4 * (range.high - range.low) + allowed;
    return std::all_of(simplex.begin(), simplex.end(), [&](const Corner& corner) {
      return corner.value >= range.low - margin && corner.value <= range.high + margin;
    });
  }

  template <int N>
  void bisect(const Simplex<N>& simplex, int depth, Moments& moments) {
    std::size_t from = 0, to = 1;
    double longest = -1;
    for (std::size_t a = 0; a <= N; ++a)
      for (std::size_t b = a + 1; b <= N; ++b) {
        const Point e = minus(simplex[a].at, simplex[b].at);
        if (dot(e, e) > longest) {
          longest = dot(e, e);
          from = a;
          to = b;
        }
      }
    Corner middle;
    for (std::size_t k = 0; k < 3; ++k) middle.at[k] = (simplex[from].at[k] + simplex[to].at[k]) / 2;
    if (!linear_) evaluate({&middle.at, 1}, {&middle.value, 1});
    for (const std::size_t replaced : {from, to}) {
      Simplex<N> half = simplex;
      half[replaced] = middle;
      add_simplex<N>(half, depth + 1, moments);
    }
  }

  /// Sums over the points that rule s adds to the one before.
  template <int N>
  Sums sum_points(const Local<N>& local, const SimplexRules& rules, std::size_t s, Range& range) {
    const std::size_t begin = s == 0 ? 0 : rules.size[s - 1], count = rules.size[s] - begin;
    const Point middle{seed_[0] + local.middle[0], seed_[1] + local.middle[1], seed_[2] + local.middle[2]};
    std::array<Point, most_points> place, at;
    std::array<double, most_points> value;
    for (std::size_t q = 0; q < count; ++q) {
      Point y{};
      for (std::size_t c = 0; c <= N; ++c)
        for (std::size_t k = 0; k < 3; ++k) y[k] += rules.point[begin + q][c] * local.corner[c][k];
      place[q] = y;
      at[q] = {middle[0] + y[0], middle[1] + y[1], middle[2] + y[2]};
    }
    source_->evaluate(std::span(at).first(count), region_, std::span(value).first(count));
    Sums sums;
    for (std::size_t q = 0; q < count; ++q) {
      range.see(value[q]);
      sums.mass += value[q];
      for (std::size_t k = 0; k < 3; ++k) sums.first[k] += value[q] * place[q][k];
      sums.second += value[q] * dot(place[q], place[q]);
    }
    return sums;
  }

  /// Rule s.
  static Sums apply(const SimplexRules& rules, std::size_t s,
                    const std::array<Sums, SimplexRules::count>& part) {
    Sums sums;
    for (std::size_t k = 0; k <= s; ++k) {
      const double weight = rules.weight[s][k];
      sums.mass += weight * part[k].mass;
      for (std::size_t c = 0; c < 3; ++c) sums.first[c] += weight * part[k].first[c];
      sums.second += weight * part[k].second;
    }
    return sums;
  }

  /// How far apart two rules are, in the unit of the mass: moments over the way from the middle to the second
  /// point.
  template <int N>
  static double difference(const Sums& a, const Sums& b, const Local<N>& local) {
    const Point moved = minus(a.first, b.first);
    return std::max(std::abs(a.mass - b.mass), std::sqrt(dot(moved, moved) / dot(local.reach, local.reach)));
  }

  static void take(const Sums& found, const Point& middle, double size, double error, Moments& moments) {
    moments.mass += size * found.mass;
    for (std::size_t k = 0; k < 3; ++k) moments.first[k] += size * (found.first[k] + found.mass * middle[k]);
    moments.second += size * (found.second + 2 * dot(found.first, middle) + found.mass * dot(middle, middle));
    moments.error += std::abs(size) * error;
  }

  std::unique_ptr<PointSource> source_;
  bool linear_;
  double cell_tolerance_, negligible_;
  int least_depth_, more_depth_;
  double tolerance_ = 0;
  Point seed_{};
  std::uint32_t region_ = 0;
  int depth_ = 0;
  static constexpr std::size_t most_points = 35;  // that rule 4 of a tetrahedron adds
  std::vector<Point> places_, at_;                // about the seed, and where that is
  std::vector<double> values_;
  std::vector<Corner> corners_;
};

}  // namespace

std::unique_ptr<PieceIntegrator> PointwiseDensity::integrator(const Domain& domain,
                                                              const Accuracy& accuracy) const {
  return std::make_unique<SimplexIntegrator>(source(domain), linear(), tolerance_, accuracy);
}

}  // namespace powercell
