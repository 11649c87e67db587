/// \file
/// Planes as rows of integers, and what their determinants decide (docs/mathematics.md (85), (86)), for
/// numbers of any kind: Wide or of Boost.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <vector>

#include "lib/cell/exact_cell.hpp"
#include "lib/cell/wide.hpp"

namespace powercell {

using Unbounded =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

template <int n>
inline int sign_of(const Wide<n>& x) {
  return x.sign();
}
inline int sign_of(const Unbounded& x) {
  return x.sign();
}

inline Scaled scaled(const Unbounded& x) {
  if (x.sign() == 0) return {};
  const Unbounded size = x.sign() < 0 ? Unbounded(-x) : x;
  const int exponent = static_cast<int>(boost::multiprecision::msb(size)) - 127;
  const Unbounded leading = exponent > 0 ? Unbounded(size >> static_cast<unsigned>(exponent))
                                         : Unbounded(size << static_cast<unsigned>(-exponent));
  const auto next = static_cast<std::uint64_t>(Unbounded(leading & ~std::uint64_t{0}));
  return scaled_by(static_cast<std::uint64_t>(Unbounded(leading >> 64)), next, exponent + 64, x.sign() < 0);
}

/// The plane n.y = offset / 2, offset = |q|^2 + w_i - w_j and n = q for a bisector.
template <class NormalType, class OffsetType>
struct ExactRow {
  using Normal = NormalType;
  using Offset = OffsetType;
  std::array<Normal, 3> normal;
  Offset offset;
};

/// With |n_k| <= 2^(64 n - 3) and |offset| < 2^(64 l - 2) no sum below exceeds its type: components of a
/// cross product are at most 2^(128 n - 5), factors 3 * 2^(192 n - 8), and the sum of four of them times a
/// offset is below 2^(192 n + 64 l - 6).
template <int n, int l>
using WideRow = ExactRow<Wide<n>, Wide<l>>;
using UnboundedRow = ExactRow<Unbounded, Unbounded>;

template <class Normal>
inline auto cross_of(const std::array<Normal, 3>& a, const std::array<Normal, 3>& b) {
  using Minor = decltype(a[0] * b[0]);
  return std::array<Minor, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                              a[0] * b[1] - a[1] * b[0]};
}
template <class A, class B>
inline auto dot_of(const std::array<A, 3>& a, const std::array<B, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Factors of the last column of det(a; b; c; p), or det(a; b; p) in the plane, whose rows are (n, -offset):
/// that of row r is the determinant with (0, ..., 0, 1) for r.
template <class Row>
inline auto factors_in_space(const Row& a, const Row& b, const Row& c, const Row& p) {
  const auto ab = cross_of(a.normal, b.normal), cp = cross_of(c.normal, p.normal);
  using Factor = decltype(dot_of(ab, c.normal));
  return std::array<Factor, 4>{-dot_of(b.normal, cp), dot_of(a.normal, cp), -dot_of(p.normal, ab),
                               dot_of(c.normal, ab)};
}
template <class Row>
inline auto factors_in_plane(const Row& a, const Row& b, const Row& p) {
  const auto minor = [](const Row& x, const Row& y) {
    return x.normal[0] * y.normal[1] - x.normal[1] * y.normal[0];
  };
  using Factor = decltype(minor(a, b));
  return std::array<Factor, 3>{minor(b, p), -minor(a, p), minor(a, b)};
}

template <std::size_t count>
inline int sign_of_sum(const std::array<Unbounded, count>& a, const std::array<Unbounded, count>& b) {
  Unbounded sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += a[k] * b[k];
  return sum.sign();
}

/// Sign of the determinant itself.
template <class Row, class Factor>
inline int determinant_sign(const Row& a, const Row& b, const Row& c, const Row& p,
                            const std::array<Factor, 4>& f) {
  return -sign_of_sum(std::array{a.offset, b.offset, c.offset, p.offset}, f);
}
template <class Row, class Factor>
inline int determinant_sign(const Row& a, const Row& b, const Row& p, const std::array<Factor, 3>& f) {
  return -sign_of_sum(std::array{a.offset, b.offset, p.offset}, f);
}

/// x / y 2^exponent.
template <class X, class Y>
inline TwoDoubles quotient(const X& x, const Y& y, int exponent) {
  const Scaled a = scaled(x), b = scaled(y);
  if (a.fraction.high == 0) return {};
  const TwoDoubles ratio = a.fraction / b.fraction;
  const int shift = a.exponent - b.exponent + exponent;
  return {std::ldexp(ratio.high, shift), std::ldexp(ratio.low, shift)};
}

/// Where the planes meet, in units of 2^exponent.
template <class Row>
inline ClosePoint meeting_in_space(const Row& a, const Row& b, const Row& c, int exponent) {
  const auto bc = cross_of(b.normal, c.normal), ca = cross_of(c.normal, a.normal),
             ab = cross_of(a.normal, b.normal);
  const auto d = dot_of(a.normal, bc);
  ClosePoint y;
  for (std::size_t k = 0; k < 3; ++k)
    y[k] = quotient(a.offset * bc[k] + b.offset * ca[k] + c.offset * ab[k], d, exponent - 1);
  return y;
}
template <class Row>
inline ClosePoint meeting_in_plane(const Row& a, const Row& b, int exponent) {
  const auto d = a.normal[0] * b.normal[1] - a.normal[1] * b.normal[0];
  return {quotient(a.offset * b.normal[1] - b.offset * a.normal[1], d, exponent - 1),
          quotient(b.offset * a.normal[0] - a.offset * b.normal[0], d, exponent - 1),
          {}};
}

/// Rows by what lies behind them (PieceBatch::border), found quickly.
template <class Row>
class RowTable {
 public:
  RowTable() { clear(); }
  void clear() {
    rows_.clear();
    borders_.clear();
    slot_.assign(least_slots, none);
  }
  const std::vector<std::int32_t>& borders() const { return borders_; }
  /// Good until a row is added; null if there is none.
  const Row* find(std::int32_t border) const {
    for (std::size_t at = place_of(border);; at = (at + 1) & (slot_.size() - 1)) {
      if (slot_[at] == none) return nullptr;
      if (borders_[slot_[at]] == border) return &rows_[slot_[at]];
    }
  }
  /// \param border  not yet there
  void add(std::int32_t border, Row row) {
    rows_.push_back(std::move(row));
    borders_.push_back(border);
    if (2 * rows_.size() <= slot_.size()) return enter(rows_.size() - 1);
    slot_.assign(2 * slot_.size(), none);
    for (std::size_t k = 0; k < rows_.size(); ++k) enter(k);
  }

 private:
  static constexpr std::size_t least_slots = 128;
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  std::size_t place_of(std::int32_t border) const {
    return (static_cast<std::uint32_t>(border) * 0x9E3779B1U >> 8) & (slot_.size() - 1);
  }
  void enter(std::size_t k) {
    std::size_t at = place_of(borders_[k]);
    while (slot_[at] != none) at = (at + 1) & (slot_.size() - 1);
    slot_[at] = static_cast<std::uint32_t>(k);
  }

  std::vector<Row> rows_;
  std::vector<std::int32_t> borders_;
  std::vector<std::uint32_t> slot_;
};

}  // namespace powercell
