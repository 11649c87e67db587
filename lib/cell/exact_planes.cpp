#include "lib/cell/exact_planes.hpp"

#include <algorithm>
#include <bit>
#include <climits>
#include <cstring>
#include <iterator>
#include <type_traits>

#include "lib/cell/host_clip.hpp"
#include "lib/domain/orientation.hpp"

namespace powercell {
namespace {

namespace mp = boost::multiprecision;

/// Bits kept free below the lowest met, so that a seed with one more does not change the unit.
constexpr int spare_bits = 6;

/// x = mantissa 2^low, the mantissa odd or 0.
struct Parts {
  std::int64_t mantissa;
  int low;
};
Parts parts_of(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int biased = static_cast<int>(bits >> 52 & 0x7FF);
  std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
  if (biased > 0) mantissa |= std::uint64_t{1} << 52;
  if (mantissa == 0) return {0, INT_MAX / 2};
  const int zeros = std::countr_zero(mantissa);
  const auto size = static_cast<std::int64_t>(mantissa >> zeros);
  return {x < 0 ? -size : size, std::max(biased, 1) - 1075 + zeros};
}

/// Exponent of the lowest bit that is set; large for 0.
int lowest_bit_of(const TwoDoubles& x) {
  return parts_of(x.low != 0 ? x.low : x.high).low;
}
/// |x| < 2^this.
int highest_bit_of(const TwoDoubles& x) {
  if (x.high == 0) return INT_MIN / 2;
  return std::max(static_cast<int>(std::bit_cast<std::uint64_t>(x.high) >> 52 & 0x7FF), 1) - 1022;
}

/// x / 2^exponent, which is an integer that fits.
template <int n>
void assign(Wide<n>& to, double x, int exponent) {
  to = {};
  const Parts parts = parts_of(x);
  if (parts.mantissa == 0) return;
  const auto shift = static_cast<unsigned>(parts.low - exponent);
  const auto mantissa = static_cast<std::uint64_t>(parts.mantissa);
  const std::uint64_t fill = parts.mantissa < 0 ? ~std::uint64_t{0} : 0;
  for (unsigned k = 0; k < n; ++k) {
    const auto from = static_cast<int>(64 * k) - static_cast<int>(shift);  // of the mantissa, sign repeated
    to.limb[k] = from <= -64 ? 0
                 : from < 0  ? mantissa << -from
                 : from == 0 ? mantissa
                 : from < 64 ? (mantissa >> from) | (fill << (64 - from))
                             : fill;
  }
}
void assign(Unbounded& to, double x, int exponent) {
  const Parts parts = parts_of(x);
  to = parts.mantissa;
  if (parts.mantissa != 0) to <<= static_cast<unsigned>(parts.low - exponent);
}
template <class Int>
Int integer(const TwoDoubles& x, int exponent) {
  Int high, low;
  assign(high, x.high, exponent);
  if (x.low == 0) return high;
  assign(low, x.low, exponent);
  return high + low;
}

/// Bits that numbers may have: of a normal, and of the difference of weights in a offset.
template <class Row>
struct Limits {
  static constexpr int normal = INT_MAX / 4, weight = INT_MAX / 4;
};
template <int n, int l>
struct Limits<WideRow<n, l>> {
  static_assert(l >= 2 * n);
  static constexpr int normal = 64 * n - 3, weight = 64 * l - 3;
};

template <int n>
bool convert(const Unbounded& x, Wide<n>& to) {
  if (x.sign() != 0 && mp::msb(mp::abs(x)) >= 64 * n - 3) return false;
  std::array<std::uint64_t, n> size{};
  if (x.sign() != 0) mp::export_bits(Unbounded(mp::abs(x)), size.begin(), 64, false);
  to.limb = size;
  if (x.sign() < 0) to = -to;
  return true;
}
bool convert(const Unbounded& x, Unbounded& to) {
  to = x;
  return true;
}

template <int n, int m>
void offset_of(const Wide<m>& square, const TwoDoubles& weight, int exponent, Wide<n>& offset) {
  offset = square.template resized<n>() + integer<Wide<n>>(weight, exponent);
}
void offset_of(const Unbounded& square, const TwoDoubles& weight, int exponent, Unbounded& offset) {
  offset = square + integer<Unbounded>(weight, exponent);
}

using ExactPoint = std::array<TwoDoubles, 3>;
using Vector = std::array<Unbounded, 3>;

Vector difference(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// A positive multiple of the vector with fewer bits: of length 1 along an axis, else without common zeros.
Vector shortened(Vector v) {
  const auto parts = std::count_if(v.begin(), v.end(), [](const Unbounded& x) { return x.sign() != 0; });
  unsigned zeros = UINT_MAX;
  for (Unbounded& x : v) {
    if (x.sign() == 0) continue;
    if (parts == 1) x = x.sign();
    zeros = std::min(zeros, static_cast<unsigned>(mp::lsb(mp::abs(x))));
  }
  if (parts > 1 && zeros > 0)
    for (Unbounded& x : v) x = x.sign() < 0 ? Unbounded(-(Unbounded(-x) >> zeros)) : Unbounded(x >> zeros);
  return v;
}

}  // namespace

template <class Row>
void ExactPlanes<Row>::start(const HostScene& scene, std::uint32_t rank, std::uint32_t region) {
  scene_ = &scene;
  rank_ = rank;
  first_ = scene.mesh->region_offset[region];
  corners_ = static_cast<int>(scene.mesh->region_offset[region + 1] - first_);
  any_ = false;
  table_.clear();
}

template <class Row>
bool ExactPlanes<Row>::cover(int low, int high) {
  const bool first = !any_;
  low_ = first ? low : std::min(low_, low);
  high_ = first ? high : std::max(high_, high);
  any_ = true;
  const int room = Limits<Row>::normal - (high_ - low_);
  if (room < 0) return false;
  if (first || low_ < exponent_ || high_ - exponent_ > Limits<Row>::normal)
    set_unit(low_ - std::min(room, spare_bits));
  return true;
}

template <class Row>
void ExactPlanes<Row>::set_unit(int exponent) {
  exponent_ = exponent;
  scale_ = exponent > -1000 && exponent < 1000 ? std::ldexp(1.0, -exponent) : 0;
}

/// Of seeds of one weight whose differences are doubles that fit the unit, as they mostly are; false if not
/// so.
template <class Row>
bool ExactPlanes<Row>::make_short_bisector(std::int32_t other, Row& row) const {
  if constexpr (std::is_same_v<typename Row::Normal, Wide<1>>) {
    const std::array<double, 4> here = scene_->points[rank_],
                                there = scene_->points[static_cast<std::size_t>(other)];
    if (!any_ || scale_ == 0 || here[3] != there[3]) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const TwoDoubles q = exact_difference(there[k], here[k]);
      const double x = q.high * scale_;
      if (q.low != 0 || !(std::abs(x) <= 0x1p61)) return false;
      const auto n = static_cast<std::int64_t>(x);
      if (static_cast<double>(n) != x) return false;
      row.normal[k].limb[0] = static_cast<std::uint64_t>(n);
    }
    offset_of(dot_of(row.normal, row.normal), {}, 0, row.offset);
    return true;
  }
  return false;
}

template <class Row>
bool ExactPlanes<Row>::make_bisector(std::int32_t other, Row& row) {
  if (make_short_bisector(other, row)) return true;
  const std::array<double, 4> here = scene_->points[rank_],
                              there = scene_->points[static_cast<std::size_t>(other)];
  const auto d = static_cast<std::size_t>(scene_->mesh->dimension);
  ExactPoint q{};
  int low = INT_MAX / 2, high = INT_MIN / 2;
  for (std::size_t k = 0; k < d; ++k) {
    q[k] = exact_difference(there[k], here[k]);
    low = std::min(low, lowest_bit_of(q[k]));
    high = std::max(high, highest_bit_of(q[k]));
  }
  const TwoDoubles weight = exact_difference(here[3], there[3]);
  if (weight.high != 0) low = std::min(low, lowest_bit_of(weight) >> 1);
  if (!cover(low, high)) return false;
  if (weight.high != 0 && highest_bit_of(weight) - 2 * exponent_ > Limits<Row>::weight) return false;
  for (std::size_t k = 0; k < 3; ++k)
    row.normal[k] = k < d ? integer<typename Row::Normal>(q[k], exponent_) : typename Row::Normal{};
  offset_of(dot_of(row.normal, row.normal), weight, 2 * exponent_, row.offset);
  return true;
}

template <class Row>
bool ExactPlanes<Row>::make_facet(std::int32_t border, Row& row) {
  const RegionMesh& mesh = *scene_->mesh;
  const std::array<double, 4> here = scene_->points[rank_];
  const auto d = static_cast<std::size_t>(mesh.dimension);
  std::vector<ExactPoint> corner(static_cast<std::size_t>(corners_));
  int low = INT_MAX / 2;
  for (std::size_t v = 0; v < corner.size(); ++v) {
    const std::array<double, 4> y = scene_->corners[mesh.region_vertex[first_ + v]];
    for (std::size_t k = 0; k < d; ++k) {
      corner[v][k] = exact_difference(y[k], here[k]);
      low = std::min(low, lowest_bit_of(corner[v][k]));
    }
  }
  if (!cover(low, low)) return false;
  const auto at = [&](int v) {
    Vector y;
    for (std::size_t k = 0; k < d; ++k)
      y[k] = integer<Unbounded>(corner[static_cast<std::size_t>(v)][k], exponent_);
    return y;
  };
  const auto across = [&](int a, int b, int c) {
    return shortened(cross_of(difference(at(b), at(a)), difference(at(c), at(a))));
  };
  const int f = border == ground_border ? 0 : ~border;
  Vector normal;
  int on = f;
  if (border == ground_border) {
    normal = across(0, 1, 2);
  } else if (mesh.cell_dimension == 3) {
    const region_shape_t& shape = scene_->shape;
    int k = 0;
    for (on = 0; shape.face[k][on] != f;)
      if (++k == 3) {
        k = 0;
        ++on;
      }
    normal = across(on, shape.next[k][on], shape.next[(k + 1) % 3][on]);
  } else {
    const Vector along = difference(at((f + 1) % corners_), at(f));
    normal = shortened(d == 2 ? Vector{along[1], -along[0], 0} : cross_of(along, across(0, 1, 2)));
  }
  const Unbounded offset = 2 * dot_of(normal, at(on));
  for (std::size_t k = 0; k < 3; ++k)
    if (!convert(normal[k], row.normal[k])) return false;
  return convert(offset, row.offset);
}

template <class Row>
bool ExactPlanes<Row>::make(std::int32_t border) {
  const auto fill = [&](std::int32_t plane, Row& row) {
    return plane >= 0 ? make_bisector(plane, row) : make_facet(plane, row);
  };
  const bool had_unit = any_;
  int unit = exponent_;
  Row row;
  if (!fill(border, row)) return false;
  if (!had_unit || exponent_ == unit) {
    table_.add(border, std::move(row));
    return true;
  }
  std::vector<std::int32_t> borders = table_.borders();
  borders.push_back(border);
  do {
    unit = exponent_;
    table_.clear();
    for (const std::int32_t other : borders) {
      if (!fill(other, row)) return false;
      table_.add(other, row);
    }
  } while (exponent_ != unit);  // it goes down only, and no further than for all of them
  return true;
}

template class ExactPlanes<WideRow<1, 2>>;
template class ExactPlanes<WideRow<1, 3>>;
template class ExactPlanes<WideRow<2, 4>>;
template class ExactPlanes<WideRow<3, 6>>;
template class ExactPlanes<UnboundedRow>;

std::uint32_t corner_of_region(const RegionMesh& mesh, std::uint32_t region, std::uint32_t k) {
  const std::uint32_t first = mesh.region_offset[region], count = mesh.region_offset[region + 1] - first;
  return mesh.region_vertex[first + k % count];
}

int corner_side(const HostScene& scene, std::uint32_t rank, std::uint32_t corner, std::int32_t other) {
  const std::array<double, 4> here = scene.points[rank],
                              there = scene.points[static_cast<std::size_t>(other)],
                              at = scene.corners[corner];
  const auto d = static_cast<std::size_t>(scene.mesh->dimension);
  const TwoDoubles weight = exact_difference(here[3], there[3]);
  ExactPoint q{}, y{};
  int unit = weight.high != 0 ? lowest_bit_of(weight) >> 1 : INT_MAX / 2;
  for (std::size_t k = 0; k < d; ++k) {
    q[k] = exact_difference(there[k], here[k]);
    y[k] = exact_difference(at[k], here[k]);
    unit = std::min({unit, lowest_bit_of(q[k]), lowest_bit_of(y[k])});
  }
  Unbounded side = -integer<Unbounded>(weight, 2 * unit);
  for (std::size_t k = 0; k < d; ++k) {
    const Unbounded n = integer<Unbounded>(q[k], unit);
    side += n * (2 * integer<Unbounded>(y[k], unit) - n);
  }
  return side.sign();
}

bool is_in_line_of_facet(const HostScene& scene, std::uint32_t region, std::uint32_t corner,
                         std::uint32_t facet) {
  const auto from = scene.corners[corner_of_region(*scene.mesh, region, facet)],
             to = scene.corners[corner_of_region(*scene.mesh, region, facet + 1)],
             point = scene.corners[corner];
  return orient2d(from.data(), to.data(), point.data()) == 0;
}

}  // namespace powercell
