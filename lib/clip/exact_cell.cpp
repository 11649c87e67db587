#include "lib/clip/exact_cell.hpp"

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "lib/clip/host_clip.hpp"

namespace powercell {
namespace {

namespace mp = boost::multiprecision;

/// Lowest and highest exponents of the bits of x, which is not 0.
struct BitRange {
  int low, high;
};
BitRange bits_of(double x) {
  int exponent = 0;
  const double fraction = std::frexp(std::abs(x), &exponent);
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  return {exponent - 53 + std::countr_zero(mantissa), exponent};
}

template <class Int>
class Exact final : public ExactCell {
 public:
  Exact(const HostScene& scene, std::uint32_t rank, std::uint32_t region)
      : scene_(scene),
        d_(scene.mesh->dimension),
        rank_(rank),
        first_(scene.mesh->region_offset[region]),
        corners_(static_cast<int>(scene.mesh->region_offset[region + 1] - first_)),
        own_(seed(rank)) {
    if (d_ == 3 && scene.mesh->cell_dimension == 2) ground_ = through(corner(0), corner(1), corner(2));
  }

  bool is_outside(const ExactVertex& vertex, std::int32_t other) override {
    if (std::find(vertex.begin(), vertex.begin() + planes(), other) != vertex.begin() + planes())
      return false;
    const Row &point = homogeneous(vertex), &plane = this->plane(other);
    const int sign = apply(plane, point).sign() * point[last()].sign();
    return (sign != 0 ? sign : infinitesimal(vertex, other, plane) * point[last()].sign()) > 0;
  }

  std::array<double, 3> place(const ExactVertex& vertex) override {
    const Row& point = homogeneous(vertex);
    std::array<double, 3> y{};
    for (std::size_t k = 0; k < last(); ++k) y[k] = quotient(point[k], point[last()]);
    return y;
  }

  bool lies_in_facet(const ExactVertex& vertex, int f) override {
    return apply(plane(~f), homogeneous(vertex)).sign() == 0;
  }

  bool is_corner_outside(std::uint32_t corner, std::int32_t other) override {
    const int sign = apply(plane(other), mesh_vertex(corner)).sign();
    return sign != 0 ? sign > 0 : static_cast<std::uint32_t>(other) < rank_;
  }

  int hull_dimension(std::span<const ExactVertex> vertices) override {
    std::vector<const Row*> distinct;
    for (const ExactVertex& vertex : vertices) {
      const Row& point = homogeneous(vertex);
      if (std::none_of(distinct.begin(), distinct.end(),
                       [&](const Row* other) { return same(point, *other); }))
        distinct.push_back(&point);
    }
    return distinct.size() <= 2 ? static_cast<int>(distinct.size()) - 1 : rank_of(distinct) - 1;
  }

 private:
  /// A plane n.y = c as (n, -c), or a point (y s, s).
  using Row = std::array<Int, 4>;

  int planes() const { return scene_.mesh->cell_dimension; }
  std::size_t last() const { return static_cast<std::size_t>(d_); }

  Int integer(double x, int exponent) const {
    if (x == 0) return Int(0);
    const BitRange range = bits_of(x);
    Int value(static_cast<std::int64_t>(std::ldexp(x, -range.low)));
    value <<= static_cast<unsigned>(range.low - exponent);
    return value;
  }

  /// Coordinates and, last, the weight.
  Row seed(std::uint32_t rank) const {
    double packed[4];
    std::memcpy(packed, scene_.points.data() + std::size_t{rank} * sizeof packed, sizeof packed);
    Row row;
    for (std::size_t k = 0; k < last(); ++k) row[k] = integer(packed[k], scene_.scale.exponent);
    row[last()] = integer(packed[3], 2 * scene_.scale.exponent);
    return row;
  }

  /// Relative to the seed, and 1.
  Row corner(int k) const {
    return mesh_vertex(scene_.mesh->region_vertex[first_ + static_cast<std::uint32_t>(k)]);
  }
  Row mesh_vertex(std::size_t at) const {
    double packed[4];
    std::memcpy(packed, scene_.corners.data() + at * sizeof packed, sizeof packed);
    Row row;
    for (std::size_t c = 0; c < last(); ++c) row[c] = integer(packed[c], scene_.scale.exponent) - own_[c];
    row[last()] = 1;
    return row;
  }

  Row bisector(std::int32_t other) const {
    const Row there = seed(static_cast<std::uint32_t>(other));
    Row row;
    Int level = own_[last()] - there[last()];
    for (std::size_t k = 0; k < last(); ++k) {
      const Int q = there[k] - own_[k];
      level += q * q;
      row[k] = q * 2;
    }
    row[last()] = -level;
    return row;
  }

  Row through(const Row& y, const Row& normal) const {
    Row row = normal;
    row[last()] = 0;
    for (std::size_t k = 0; k < last(); ++k) row[last()] -= normal[k] * y[k];
    return row;
  }
  static Row cross(const Row& a, const Row& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], Int(0)};
  }
  Row less(const Row& a, const Row& b) const {
    Row row;
    for (std::size_t k = 0; k < last(); ++k) row[k] = a[k] - b[k];
    return row;
  }
  Row through(const Row& y, const Row& a, const Row& b) const {
    return through(y, cross(less(a, y), less(b, y)));
  }

  Row facet(int f) const {
    if (scene_.mesh->cell_dimension == 3) {
      const region_shape_t& shape = scene_.shape;
      for (int v = 0;; ++v)
        for (int k = 0; k < 3; ++k)
          if (shape.face[k][v] == f)
            return through(corner(v), corner(shape.next[k][v]), corner(shape.next[(k + 1) % 3][v]));
    }
    const Row y = corner(f), along = less(corner((f + 1) % corners_), y);
    if (d_ == 2) return through(y, Row{along[1], -along[0], Int(0), Int(0)});
    return through(y, cross(along, ground_));
  }

  const Row& plane(std::int32_t border) {
    auto found = planes_.find(border);
    if (found == planes_.end())
      found = planes_.emplace(border, border >= 0 ? bisector(border) : facet(~border)).first;
    return found->second;
  }

  static Int determinant(const Int& a, const Int& b, const Int& c, const Int& d) { return a * d - b * c; }
  /// The vector p with det(rows, r) = r.p for all r.
  Row meeting(const Row& a, const Row& b) const {  // d = 2
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], Int(0)};
  }
  Row meeting(const Row& a, const Row& b, const Row& c) const {
    const Int m01 = determinant(b[0], b[1], c[0], c[1]), m02 = determinant(b[0], b[2], c[0], c[2]),
              m03 = determinant(b[0], b[3], c[0], c[3]), m12 = determinant(b[1], b[2], c[1], c[2]),
              m13 = determinant(b[1], b[3], c[1], c[3]), m23 = determinant(b[2], b[3], c[2], c[3]);
    Row p;
    p[0] = -(a[1] * m23 - a[2] * m13 + a[3] * m12);
    p[1] = a[0] * m23 - a[2] * m03 + a[3] * m02;
    p[2] = -(a[0] * m13 - a[1] * m03 + a[3] * m01);
    p[3] = a[0] * m12 - a[1] * m02 + a[2] * m01;
    return p;
  }

  Row meeting_of(const std::array<const Row*, 3>& rows) const {
    return d_ == 2 ? meeting(*rows[0], *rows[1]) : meeting(*rows[0], *rows[1], *rows[2]);
  }
  std::array<const Row*, 3> rows_of(const ExactVertex& vertex) {
    const bool solid = scene_.mesh->cell_dimension == 3;
    return {&plane(vertex[0]), &plane(vertex[1]), solid ? &plane(vertex[2]) : &ground_};
  }

  const Row& homogeneous(const ExactVertex& vertex) {
    auto found = points_.find(vertex);
    if (found == points_.end()) found = points_.emplace(vertex, meeting_of(rows_of(vertex))).first;
    return found->second;
  }

  Int apply(const Row& plane, const Row& point) const {
    Int sum = plane[0] * point[0];
    for (std::size_t k = 1; k <= last(); ++k) sum += plane[k] * point[k];
    return sum;
  }

  /// Sign of det(rows of the vertex, plane) once all weights are larger by their infinitesimals: a bisector
  /// with j gains (e_j - e_i) times the row (0, ..., 0, 1), and its determinant the like with that row put
  /// in.
  int infinitesimal(const ExactVertex& vertex, std::int32_t other, const Row& plane) {
    std::array<std::int32_t, 5> seeds{static_cast<std::int32_t>(rank_), other};
    std::size_t count = 2;
    for (std::size_t k = 0; k < static_cast<std::size_t>(planes()); ++k)
      if (vertex[k] >= 0) seeds[count++] = vertex[k];
    std::sort(seeds.begin(), seeds.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t k = 0; k < count; ++k) {
      const int sign = factor(vertex, other, plane, seeds[k]).sign();
      if (sign != 0) return sign;
    }
    return 0;  // cannot be: the factor of `other` is the denominator of the vertex
  }

  /// Of the infinitesimal of one of those seeds.
  Int factor(const ExactVertex& vertex, std::int32_t other, const Row& plane, std::int32_t seed) {
    if (seed == other) return homogeneous(vertex)[last()];
    if (seed == static_cast<std::int32_t>(rank_)) {
      Int own = -homogeneous(vertex)[last()];
      for (std::size_t k = 0; k < static_cast<std::size_t>(planes()); ++k)
        if (vertex[k] >= 0) own -= factor(vertex, other, plane, vertex[k]);
      return own;
    }
    Row unit;
    std::fill(unit.begin(), unit.end(), Int(0));
    unit[last()] = 1;
    std::array<const Row*, 3> rows = rows_of(vertex);
    rows[static_cast<std::size_t>(std::find(vertex.begin(), vertex.end(), seed) - vertex.begin())] = &unit;
    return apply(plane, meeting_of(rows));
  }

  /// p / q in the units of the scene.
  double quotient(const Int& p, const Int& q) const {
    if (p.sign() == 0) return 0;
    const auto parts = [](const Int& x, int& exponent) {
      const Int size = x.sign() < 0 ? Int(-x) : x;
      exponent = static_cast<int>(mp::msb(size)) - 62;
      const Int top = exponent > 0 ? Int(size >> static_cast<unsigned>(exponent))
                                   : Int(size << static_cast<unsigned>(-exponent));
      return static_cast<long double>(static_cast<std::uint64_t>(top)) * x.sign();
    };
    int ep = 0, eq = 0;
    const long double a = parts(p, ep), b = parts(q, eq);
    return static_cast<double>(std::ldexp(a / b, ep - eq + scene_.scale.exponent));
  }

  bool same(const Row& a, const Row& b) const {
    for (std::size_t k = 0; k < last(); ++k)
      if (a[k] * b[last()] != b[k] * a[last()]) return false;
    return true;
  }

  /// Rank of the homogeneous points, by elimination without fractions.
  int rank_of(const std::vector<const Row*>& points) const {
    using Wide = std::array<mp::cpp_int, 4>;
    std::vector<Wide> echelon;
    std::vector<std::size_t> pivot;
    for (const Row* point : points) {
      Wide row;
      for (std::size_t k = 0; k <= last(); ++k) row[k] = mp::cpp_int((*point)[k]);
      for (std::size_t b = 0; b < echelon.size(); ++b) {
        const mp::cpp_int here = row[pivot[b]], there = echelon[b][pivot[b]];
        if (here == 0) continue;
        for (std::size_t k = 0; k <= last(); ++k) row[k] = row[k] * there - echelon[b][k] * here;
      }
      std::size_t k = 0;
      while (k <= last() && row[k] == 0) ++k;
      if (k > last()) continue;
      echelon.push_back(row);
      pivot.push_back(k);
      if (echelon.size() == last() + 1) break;
    }
    return static_cast<int>(echelon.size());
  }

  const HostScene& scene_;
  const int d_;
  const std::uint32_t rank_, first_;
  const int corners_;
  const Row own_;
  Row ground_;
  std::map<std::int32_t, Row> planes_;
  std::map<ExactVertex, Row> points_;
};

template <unsigned bits>
using Fixed =
    mp::number<mp::cpp_int_backend<bits, bits, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;

}  // namespace

ExactScale exact_scale(std::span<const std::byte> points, std::span<const std::byte> corners) {
  int low = 0, high = 0;
  bool any = false;
  const auto widen = [&](int from, int to) {
    low = any ? std::min(low, from) : from;
    high = any ? std::max(high, to) : to;
    any = true;
  };
  for (const std::span<const std::byte> rows : {points, corners})
    for (std::size_t at = 0; at + 4 * sizeof(double) <= rows.size(); at += 4 * sizeof(double)) {
      double packed[4];
      std::memcpy(packed, rows.data() + at, sizeof packed);
      for (int k = 0; k < 4; ++k) {
        if (packed[k] == 0) continue;
        const BitRange range = bits_of(packed[k]);
        if (k < 3)
          widen(range.low, range.high);
        else  // twice the exponent, rounded away
          widen((range.low - (range.low % 2 != 0 ? 1 : 0)) / 2, range.high / 2 + 1);
      }
    }
  return {low, high - low + 1};
}

std::unique_ptr<ExactCell> ExactCell::make(const HostScene& scene, std::uint32_t rank, std::uint32_t region) {
  // Largest number met: a plane applied to the meeting of facets, 10 coordinates' worth on surfaces.
  const int most = 10 * (scene.scale.bits + 2) + 16;
  if (most <= 640) return std::make_unique<Exact<Fixed<640>>>(scene, rank, region);
  if (most <= 2048) return std::make_unique<Exact<Fixed<2048>>>(scene, rank, region);
  return std::make_unique<Exact<mp::cpp_int>>(scene, rank, region);
}

}  // namespace powercell
