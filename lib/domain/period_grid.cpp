#include "lib/domain/period_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/base/compiler.hpp"

namespace powercell {
namespace {

/// The upper half of the product.
std::int64_t high_product(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>((static_cast<Int128>(a) * b) >> 64);
}

/// x * 2^by, rounded down.
/// \pre it fits
std::int64_t scaled(std::int64_t x, std::int64_t by) {
  return by >= 0 ? static_cast<std::int64_t>(static_cast<std::uint64_t>(x) << by) : x >> -by;
}

/// |x| = mantissa * 2^exponent.
struct Digits {
  std::uint64_t mantissa;
  std::int64_t exponent;
  bool negative;
};

Digits digits_of(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t field = bits >> 52 & 0x7ff, fraction = bits & ((std::uint64_t{1} << 52) - 1);
  return {field > 0 ? fraction | std::uint64_t{1} << 52 : fraction,
          static_cast<std::int64_t>(std::max<std::uint64_t>(field, 1)) - 1075, bits >> 63 != 0};
}

/// Whether mantissa * 2^by >= 2^range.
bool is_beyond(std::uint64_t mantissa, std::int64_t by, std::int64_t range) {
  return mantissa != 0 && static_cast<std::int64_t>(std::bit_width(mantissa)) + by > range;
}

/// mantissa * 2^by, rounded down, modulo 2^64.
std::uint64_t whole(std::uint64_t mantissa, std::int64_t by) {
  if (by >= 64 || by <= -64) return 0;
  return by >= 0 ? mantissa << by : mantissa >> -by;
}

/// Whether mantissa * 2^by exceeds whole() by more than a half, or by a half where `odd`.
bool is_rounded_up(std::uint64_t mantissa, std::int64_t by, bool odd) {
  if (by >= 0 || by <= -64) return false;  // mantissas have 53 bits
  const std::uint64_t half = std::uint64_t{1} << (-by - 1), rest = mantissa & (2 * half - 1);
  return rest > half || (rest == half && odd);
}

/// The exponent e of the least power 2^e above |x|; 0 for 0.
int exponent_of(long double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return exponent;
}

}  // namespace

PeriodGrid::PeriodGrid(const PeriodVectors& lattice) {
  const auto set = [this](int which, std::size_t at, std::int64_t value) {
    numbers_[static_cast<std::size_t>(which) + at] = value;
  };
  set(PERIOD_COUNT, 0, lattice.count);
  set(PERIOD_IS_BOX, 0, lattice.is_box ? 1 : 0);
  for (std::size_t c = 0; c < 3; ++c) {
    const double quantum = lattice.quantum[c];
    if (quantum == 0) continue;
    set(PERIOD_ROUNDED, c, 1);
    set(PERIOD_QUANTUM, c, std::ilogb(quantum));
    const double origin = lattice.origin[c] / quantum;
    set(PERIOD_ORIGIN, c,
        static_cast<std::int64_t>(lattice.is_box ? std::ceil(origin) : std::nearbyint(origin)));
    long double most = std::fabs(origin);
    for (std::size_t k = 0; k < 3; ++k) {
      set(PERIOD_VECTOR, 3 * k + c, static_cast<std::int64_t>(lattice.vector[k][c] / quantum));
      most += PERIOD_MOST * std::fabs(static_cast<long double>(number(PERIOD_VECTOR, 3 * k + c)));
    }
    set(PERIOD_RANGE, c, exponent_of(most));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<long double, 3> dual{};
    long double most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      dual[c] = std::ldexp(static_cast<long double>(lattice.dual[k][c]) * lattice.quantum[c],
                           static_cast<int>(number(PERIOD_RANGE, c)) - PERIOD_WORD);
      most = std::max(most, std::fabs(dual[c]));
      set(PERIOD_GIVEN, 3 * k + c, lattice.of_given[k][c]);
    }
    const int exponent = PERIOD_WORD + 1 - exponent_of(most);
    set(PERIOD_BITS, k, exponent - 64);
    for (std::size_t c = 0; c < 3; ++c)
      set(PERIOD_DUAL, 3 * k + c, static_cast<std::int64_t>(std::ldexp(dual[c], exponent)));
  }
}

/// The coordinate of a point near the origin along vector k, times 2^(PERIOD_BITS + PERIOD_FINE).
std::int64_t PeriodGrid::fraction(const Point& at, std::size_t k) const {
  std::int64_t sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (number(PERIOD_ROUNDED, c) == 0) continue;
    const std::int64_t unit = PERIOD_WORD + PERIOD_FINE - number(PERIOD_RANGE, c);
    sum += high_product(number(PERIOD_DUAL, 3 * k + c), scaled(at[c] - number(PERIOD_ORIGIN, c), unit));
  }
  return sum;
}

PeriodGrid::Point PeriodGrid::moved(const Point& at, const std::array<std::int64_t, 3>& by) const {
  Point to = at;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c) to[c] += by[k] * number(PERIOD_VECTOR, 3 * k + c);
  return to;
}

/// Moves a point that the estimate has left beyond a border.
/// \return the shift applied
std::array<std::int64_t, 3> PeriodGrid::settle_in_box(Point& at) const {
  std::array<std::int64_t, 3> by{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int64_t size = number(PERIOD_VECTOR, 3 * k + c), low = number(PERIOD_ORIGIN, c);
      if (size == 0) continue;
      if (at[c] < low) by[k] = 1;
      if (at[c] >= low + size) by[k] = -1;
      at[c] += by[k] * size;
    }
  return by;
}

/// Of the images near the border, which rounding may have put on either side, takes the one first in the
/// order of coordinates: so equal images are wrapped to equal places.
/// \return the shift applied
std::array<std::int64_t, 3> PeriodGrid::settle_in_lattice(Point& at) const {
  const Point first = at;
  std::array<std::int64_t, 3> best{}, v{};
  bool found = false;
  const auto near = [&](std::size_t k, std::int64_t by) {
    if (static_cast<std::int64_t>(k) >= number(PERIOD_COUNT)) return by == 0;
    const std::int64_t one = scaled(1, number(PERIOD_BITS, k) + PERIOD_FINE),
                       slack = one >> PERIOD_SLACK_BITS, f = fraction(first, k) + by * one;
    return f >= -slack && f <= one + slack;
  };
  for (v[0] = -1; v[0] <= 1; ++v[0])
    for (v[1] = -1; v[1] <= 1 && near(0, v[0]); ++v[1])
      for (v[2] = -1; v[2] <= 1 && near(1, v[1]); ++v[2]) {
        if (!near(2, v[2])) continue;
        const Point candidate = moved(first, v);
        if (found && !(candidate < at)) continue;
        found = true;
        at = candidate;
        best = v;
      }
  return best;
}

PeriodGrid::Place PeriodGrid::wrap(const double* x) const {
  Place place;
  std::array<Digits, 3> digits{};
  Point coarse{};
  for (std::size_t c = 0; c < 3; ++c) {
    if (number(PERIOD_ROUNDED, c) == 0) continue;
    digits[c] = digits_of(x[c]);
    digits[c].exponent -= number(PERIOD_QUANTUM, c);
    const std::int64_t range = number(PERIOD_RANGE, c), unit = PERIOD_WORD - range;
    place.is_far = is_beyond(digits[c].mantissa, digits[c].exponent, range);
    if (place.is_far) return place;
    const auto size = static_cast<std::int64_t>(whole(digits[c].mantissa, digits[c].exponent + unit));
    coarse[c] = (digits[c].negative ? -size : size) - scaled(number(PERIOD_ORIGIN, c), unit);
  }
  std::array<std::int64_t, 3> shift{};  // in the vectors of the lattice
  for (std::size_t k = 0; k < 3; ++k) {
    std::int64_t sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += high_product(number(PERIOD_DUAL, 3 * k + c), coarse[c]);
    shift[k] = scaled(sum, -number(PERIOD_BITS, k));
    place.is_far = place.is_far || shift[k] >= PERIOD_MOST || shift[k] < -PERIOD_MOST;
  }
  if (place.is_far) return place;
  for (std::size_t c = 0; c < 3; ++c) {
    if (number(PERIOD_ROUNDED, c) == 0) continue;
    // Modulo 2^64, of which the difference is a small part.
    std::uint64_t there = 0;
    for (std::size_t k = 0; k < 3; ++k)
      there +=
          static_cast<std::uint64_t>(shift[k]) * static_cast<std::uint64_t>(number(PERIOD_VECTOR, 3 * k + c));
    const std::uint64_t size = whole(digits[c].mantissa, digits[c].exponent),
                        rest = (digits[c].negative ? 0 - size : size) - there;
    const bool up = is_rounded_up(digits[c].mantissa, digits[c].exponent, (rest & 1) != 0);
    place.at[c] = static_cast<std::int64_t>(rest) + (up ? (digits[c].negative ? -1 : 1) : 0);
  }
  const std::array<std::int64_t, 3> by =
      number(PERIOD_IS_BOX) != 0 ? settle_in_box(place.at) : settle_in_lattice(place.at);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t m = 0; m < 3; ++m)
      place.shift[m] += (shift[k] - by[k]) * number(PERIOD_GIVEN, 3 * k + m);
  for (const std::int64_t given : place.shift)
    place.is_far = place.is_far || given > 2 * PERIOD_MOST || given < -2 * PERIOD_MOST;
  return place;
}

}  // namespace powercell
