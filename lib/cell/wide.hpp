/// \file
/// Integers of a fixed number of limbs, for decisions that are made by the million: without allocation, with
/// loops that the compiler unrolls, and with products of exactly the length needed.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lib/base/compiler.hpp"
#include "lib/base/two_doubles.hpp"

namespace powercell {

using Limbs2 = UnsignedInt128;
using SignedLimbs2 = Int128;

/// An integer in two's complement, least limb first. Sums and differences must fit n limbs; products always
/// fit.
template <int n>
struct Wide {
  std::array<std::uint64_t, n> limb{};

  static constexpr int limbs = n;
  bool negative() const { return limb[n - 1] >> 63 != 0; }
  int sign() const {
    std::uint64_t any = 0;
    for (const std::uint64_t part : limb) any |= part;
    return negative() ? -1 : any != 0;
  }
  /// The same number in m limbs: drops the upper limbs or extends the sign.
  template <int m>
  Wide<m> resized() const {
    Wide<m> x;
    for (int k = 0; k < m; ++k)
      x.limb[static_cast<std::size_t>(k)] =
          k < n ? limb[static_cast<std::size_t>(k)] : (negative() ? ~std::uint64_t{0} : 0);
    return x;
  }
};

inline SignedLimbs2 as_number(const Wide<2>& x) {
  return static_cast<SignedLimbs2>(static_cast<Limbs2>(x.limb[1]) << 64 | x.limb[0]);
}
inline Wide<2> as_wide(SignedLimbs2 x) {
  return {{static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(static_cast<Limbs2>(x) >> 64)}};
}

template <int n>
inline Wide<n> operator+(const Wide<n>& a, const Wide<n>& b) {
  if constexpr (n == 2) return as_wide(as_number(a) + as_number(b));
  Wide<n> sum;
  Limbs2 carry = 0;
  for (std::size_t k = 0; k < n; ++k) {
    carry += static_cast<Limbs2>(a.limb[k]) + b.limb[k];
    sum.limb[k] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  return sum;
}

template <int n>
inline Wide<n> operator-(const Wide<n>& a, const Wide<n>& b) {
  if constexpr (n == 2) return as_wide(as_number(a) - as_number(b));
  Wide<n> difference;
  std::uint64_t borrow = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Limbs2 part = static_cast<Limbs2>(a.limb[k]) - b.limb[k] - borrow;
    difference.limb[k] = static_cast<std::uint64_t>(part);
    borrow = static_cast<std::uint64_t>(part >> 64) & 1;
  }
  return difference;
}

template <int n>
inline Wide<n> operator-(const Wide<n>& a) {
  return Wide<n>{} - a;
}

template <int n, int m>
inline Wide<n + m> operator*(const Wide<n>& a, const Wide<m>& b) {
  Wide<n + m> product;
  if constexpr (n == 1 && m == 1) {
    return as_wide(static_cast<SignedLimbs2>(static_cast<std::int64_t>(a.limb[0])) *
                   static_cast<std::int64_t>(b.limb[0]));
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < m; ++j) {
        const Limbs2 part = static_cast<Limbs2>(a.limb[i]) * b.limb[j] + product.limb[i + j] + carry;
        product.limb[i + j] = static_cast<std::uint64_t>(part);
        carry = static_cast<std::uint64_t>(part >> 64);
      }
      product.limb[i + m] = carry;
    }
    // The product so far is that of unsigned factors: a negative one counted as itself plus 2^64n.
    const auto take = [&](const auto& x, std::size_t from, bool negative) {
      const std::uint64_t mask = negative ? ~std::uint64_t{0} : 0;
      std::uint64_t borrow = 0;
      for (std::size_t k = 0; k < x.limb.size(); ++k) {
        const Limbs2 part = static_cast<Limbs2>(product.limb[from + k]) - (x.limb[k] & mask) - borrow;
        product.limb[from + k] = static_cast<std::uint64_t>(part);
        borrow = static_cast<std::uint64_t>(part >> 64) & 1;
      }
    };
    take(b, n, a.negative());
    take(a, m, b.negative());
  }
  return product;
}

/// a.b where |a_k| <= 2^61: then the sums of the products with the lower limbs fit two limbs.
inline Wide<3> dot_of(const std::array<Wide<1>, 3>& a, const std::array<Wide<2>, 3>& b) {
  SignedLimbs2 low = 0, high = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto factor = static_cast<SignedLimbs2>(static_cast<std::int64_t>(a[k].limb[0]));
    low += factor * static_cast<SignedLimbs2>(b[k].limb[0]);
    high += factor * static_cast<std::int64_t>(b[k].limb[1]);
  }
  const Wide<2> top = as_wide(high + (low >> 64));
  return {{static_cast<std::uint64_t>(low), top.limb[0], top.limb[1]}};
}

/// Sign of the sum of up to 2^60 products a_k b_k. Sums up the columns of limbs first and carries once.
template <int n, int m, std::size_t count>
inline int sign_of_sum(const std::array<Wide<n>, count>& a, const std::array<Wide<m>, count>& b) {
  std::array<SignedLimbs2, n + m> column{};
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < m; ++j) {
        const std::uint64_t x = a[k].limb[i], y = b[k].limb[j];
        const bool signed_x = i + 1 == n, signed_y = j + 1 == m;  // the last limbs
        if (!signed_x && !signed_y) {
          const Limbs2 product = static_cast<Limbs2>(x) * y;
          column[i + j] += static_cast<SignedLimbs2>(static_cast<std::uint64_t>(product));
          column[i + j + 1] += static_cast<SignedLimbs2>(static_cast<std::uint64_t>(product >> 64));
        } else {
          const auto value = [](std::uint64_t limb, bool is_signed) {
            return is_signed ? static_cast<SignedLimbs2>(static_cast<std::int64_t>(limb))
                             : static_cast<SignedLimbs2>(limb);
          };
          const SignedLimbs2 product = value(x, signed_x) * value(y, signed_y);
          column[i + j] += static_cast<SignedLimbs2>(static_cast<std::uint64_t>(product));
          column[i + j + 1] += product >> 64;
        }
      }
  std::uint64_t any = 0;
  for (std::size_t k = 0; k + 1 < column.size(); ++k) {
    any |= static_cast<std::uint64_t>(column[k]);
    column[k + 1] += column[k] >> 64;
  }
  const SignedLimbs2 top = column.back();
  return top < 0 ? -1 : top > 0 || any != 0;
}

/// x = fraction 2^exponent but for 2^-104 of it, or 0.
struct Scaled {
  TwoDoubles fraction;
  int exponent;
};
/// \param top, next  the leading 128 bits, the first of them set
inline Scaled scaled_by(std::uint64_t top, std::uint64_t next, int exponent, bool negative) {
  const auto high = static_cast<double>(top >> 11 << 11),
             low = std::ldexp(static_cast<double>((top & 0x7FF) << 42 | next >> 22), -42);
  const TwoDoubles size = joined(high, low);
  return {negative ? -size : size, exponent};
}
template <int n>
inline Scaled scaled(const Wide<n>& x) {
  const bool negative = x.negative();
  const Wide<n> size = negative ? -x : x;
  for (std::size_t k = n; k-- > 0;) {
    if (size.limb[k] == 0) continue;
    const int shift = std::countl_zero(size.limb[k]);
    const auto word = [&](std::size_t below) {
      const std::uint64_t here = k >= below ? size.limb[k - below] : 0,
                          next = k > below ? size.limb[k - below - 1] : 0;
      return shift == 0 ? here : here << shift | next >> (64 - shift);
    };
    return scaled_by(word(0), word(1), static_cast<int>(64 * k) - shift, negative);
  }
  return {};
}

}  // namespace powercell
