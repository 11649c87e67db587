#include "lib/density/pointwise.hpp"

#include <algorithm>
#include <cmath>

#include "lib/density/simplex_rule.hpp"

namespace powercell {
namespace {

/// A simplex of N+1 corners, about the seed.
template <int N>
using Simplex = std::array<Point, N + 1>;

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double measure(const Simplex<1>& s) {
  const Point e = minus(s[1], s[0]);
  return std::sqrt(dot(e, e));
}
double measure(const Simplex<2>& s) {
  const Point normal = cross(minus(s[1], s[0]), minus(s[2], s[0]));
  return std::sqrt(dot(normal, normal)) / 2;
}
/// Signed: fans of solids that rounding has bent cancel.
double measure(const Simplex<3>& s) {
  return dot(minus(s[1], s[0]), cross(minus(s[2], s[0]), minus(s[3], s[0]))) / 6;
}

/// Walls make the matrix of an iteration, whose result they do not change.
constexpr double wall_tolerance = 1e-6;

/// Integrates by the rules of a simplex, going to the next until the error is within the tolerance, and then
/// bisecting the longest edge.
class SimplexIntegrator : public PieceIntegrator {
 public:
  SimplexIntegrator(std::unique_ptr<PointSource> source, bool linear, double tolerance,
                    const Accuracy& accuracy)
      : source_(std::move(source)),
        linear_(linear),
        cell_tolerance_(tolerance),
        negligible_(accuracy.negligible_density),
        least_depth_(accuracy.least_depth),
        more_depth_(accuracy.more_depth) {}

  void add(const Piece& piece, const Point& seed, Moments& moments) override {
    seed_ = seed;
    region_ = piece.region();
    tolerance_ = cell_tolerance_;
    depth_ = (piece.solid() ? 12 : 20) + more_depth_;
    const Point apex = minus(middle_of(piece), seed);
    if (!piece.solid()) {
      Point before = minus(piece.vertex(piece.vertex_count() - 1), seed);
      for (std::uint64_t k = 0; k < piece.vertex_count(); ++k) {
        const Point next = minus(piece.vertex(k), seed);
        add_simplex<2>({apex, before, next}, 0, moments);
        before = next;
      }
      return;
    }
    for (std::uint64_t f = piece.first_face(); f < piece.end_face(); ++f)
      for_triangles(piece, f, [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
        add_simplex<3>(
            {apex, minus(piece.vertex(a), seed), minus(piece.vertex(b), seed), minus(piece.vertex(c), seed)},
            0, moments);
      });
  }

  double over_face(const Piece& piece, std::uint64_t face) override {
    region_ = piece.region();
    tolerance_ = std::max(cell_tolerance_, wall_tolerance);
    depth_ = piece.solid() ? 10 : 8;
    Moments moments;
    seed_ = piece.vertex(piece.corner(face, 0));
    if (!piece.solid()) {
      add_simplex<1>({Point{}, minus(piece.vertex(piece.corner(face, 1)), seed_)}, 0, moments);
      return moments.mass;
    }
    for_triangles(piece, face, [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
      add_simplex<2>(
          {minus(piece.vertex(a), seed_), minus(piece.vertex(b), seed_), minus(piece.vertex(c), seed_)}, 0,
          moments);
    });
    return moments.mass;
  }

 private:
  /// The mean of the vertices: simplices from there are smaller than those from a vertex.
  static Point middle_of(const Piece& piece) {
    Point sum{};
    for (std::uint64_t v = 0; v < piece.vertex_count(); ++v)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += piece.vertex(v)[k];
    for (double& x : sum) x /= static_cast<double>(piece.vertex_count());
    return sum;
  }

  template <class Body>
  static void for_triangles(const Piece& piece, std::uint64_t face, const Body& body) {
    const std::uint64_t count = piece.corner_count(face), first = piece.corner(face, 0);
    for (std::uint64_t k = 2; k < count; ++k) body(first, piece.corner(face, k - 1), piece.corner(face, k));
  }

  /// What one rule gives, over a simplex of measure 1.
  struct Estimate {
    double mass = 0;
    Point first{};
  };

  template <int N>
  void add_simplex(const Simplex<N>& simplex, int depth, Moments& moments) {
    const double size = measure(simplex);
    if (size == 0) return;
    if (depth < least_depth_) return bisect<N>(simplex, depth, moments);
    const SimplexRules& rules = simplex_rules(N);
    std::size_t known = 0;
    std::array<Estimate, SimplexRules::count> found;
    double before = 0;
    for (std::size_t s = 0; s < SimplexRules::count; ++s) {
      evaluate<N>(simplex, rules, known, rules.size[s]);
      known = rules.size[s];
      found[s] = estimate(rules, s);
      if (s == 0) continue;
      if (linear_) return take(rules, s, size, 0, moments);
      const double change = difference(found[s], found[s - 1]);
      if (s > 1) {
        // Where changes shrink they go on shrinking; a factor of 4 is for safety.
        const double left = change * (before > 0 ? std::min(1.0, 4 * change / before) : 1.0);
        const double allowed = tolerance_ * std::max(std::abs(found[s].mass), negligible_);
        const bool last = s + 1 == SimplexRules::count;
        const bool good = left <= allowed && corners_fit<N>(simplex, rules.size[s], allowed);
        if (good || (last && depth == depth_)) return take(rules, s, size, good ? 0 : left, moments);
      }
      before = change;
    }
    bisect<N>(simplex, depth, moments);
  }

  /// Points of rules lie inside, so a jump across a corner goes between them. Next to a smooth extremum the
  /// values at corners are farther out than those at the points by up to twice the range of these.
  template <int N>
  bool corners_fit(const Simplex<N>& simplex, std::size_t points, double allowed) {
    const auto [low, high] = std::minmax_element(value_.begin(), value_.begin() + points);
    const double margin = 4 * (*high - *low) + allowed;
    std::array<Point, N + 1> corner;
    std::array<double, N + 1> value;
    for (std::size_t c = 0; c <= N; ++c)
      for (std::size_t k = 0; k < 3; ++k) corner[c][k] = seed_[k] + simplex[c][k];
    source_->evaluate(corner, region_, value);
    return std::all_of(value.begin(), value.end(),
                       [&](double v) { return v >= *low - margin && v <= *high + margin; });
  }

  template <int N>
  void bisect(const Simplex<N>& simplex, int depth, Moments& moments) {
    std::size_t from = 0, to = 1;
    double longest = -1;
    for (std::size_t a = 0; a <= N; ++a)
      for (std::size_t b = a + 1; b <= N; ++b) {
        const Point e = minus(simplex[a], simplex[b]);
        if (dot(e, e) > longest) {
          longest = dot(e, e);
          from = a;
          to = b;
        }
      }
    Point middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (simplex[from][k] + simplex[to][k]) / 2;
    for (const std::size_t replaced : {from, to}) {
      Simplex<N> half = simplex;
      half[replaced] = middle;
      add_simplex<N>(half, depth + 1, moments);
    }
  }

  /// Places and values of the points [begin, end) of the rules.
  template <int N>
  void evaluate(const Simplex<N>& simplex, const SimplexRules& rules, std::size_t begin, std::size_t end) {
    for (std::size_t q = begin; q < end; ++q) {
      Point y{};
      for (std::size_t c = 0; c <= N; ++c)
        for (std::size_t k = 0; k < 3; ++k) y[k] += rules.point[q][c] * simplex[c][k];
      place_[q] = y;
      at_[q] = {seed_[0] + y[0], seed_[1] + y[1], seed_[2] + y[2]};
    }
    source_->evaluate(std::span(at_).subspan(begin, end - begin), region_,
                      std::span(value_).subspan(begin, end - begin));
  }

  Estimate estimate(const SimplexRules& rules, std::size_t s) const {
    Estimate sum;
    for (std::size_t q = 0; q < rules.size[s]; ++q) {
      const double part = rules.weight[s][q] * value_[q];
      sum.mass += part;
      for (std::size_t k = 0; k < 3; ++k) sum.first[k] += part * (place_[q][k] - place_[0][k]);
    }
    return sum;
  }

  /// How far apart two estimates are, in the unit of the mass: moments are about the middle, over the size
  /// of the simplex.
  double difference(const Estimate& a, const Estimate& b) const {
    const Point reach = minus(place_[1], place_[0]), moved = minus(a.first, b.first);
    return std::max(std::abs(a.mass - b.mass), std::sqrt(dot(moved, moved) / dot(reach, reach)));
  }

  void take(const SimplexRules& rules, std::size_t s, double size, double error, Moments& moments) const {
    for (std::size_t q = 0; q < rules.size[s]; ++q) {
      const double part = size * rules.weight[s][q] * value_[q];
      moments.mass += part;
      for (std::size_t k = 0; k < 3; ++k) moments.first[k] += part * place_[q][k];
      moments.second += part * dot(place_[q], place_[q]);
    }
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
  static constexpr std::size_t most_points = 70;  // rule 4 of a tetrahedron
  std::array<Point, most_points> place_, at_;     // about the seed, and where that is
  std::array<double, most_points> value_;
};

}  // namespace

std::unique_ptr<PieceIntegrator> PointwiseDensity::integrator(const Domain& domain,
                                                              const Accuracy& accuracy) const {
  return std::make_unique<SimplexIntegrator>(source(domain), linear(), tolerance_, accuracy);
}

}  // namespace powercell
