#include "lib/domain/period.hpp"

#include <algorithm>
#include <cmath>
#include <powercell/error.hpp>
#include <string>

#include "lib/base/text.hpp"
#include "lib/base/threads.hpp"
#include "lib/base/vectors.hpp"
#include "lib/domain/reduce_basis.hpp"

namespace powercell {
namespace {

constexpr double most_ratio = 1e6;       ///< of the lengths of a reduced basis
constexpr double dependent = 0x1p-46;    ///< length of a reduced vector relative to those given
constexpr double most_change = 0x1p-12;  ///< of a vector when it is rounded, relative to the shortest one

[[noreturn]] void refuse_period(const std::string& what) {
  throw Error(ErrorCode::invalid_domain, what);
}

/// \throw Error invalid_domain
void check_lengths(double shortest, double longest, const std::string& what) {
  if (longest <= most_ratio * shortest) return;
  refuse_period(
      "the periods of the " + what + " are " + digits(shortest) + " and " + digits(longest) +
      " long, more than a factor of 10^6 apart; scale the long direction down, or make the short one a "
      "bounded axis of a periodic box");
}

double length(const Period::Coordinates& v) {
  return norm(Vector3<double>(v));
}

}  // namespace

Period Period::of_box(std::span<const double> low, std::span<const double> high, std::array<bool, 3> axes) {
  Period period;
  period.dimension_ = static_cast<int>(low.size());
  period.is_box_ = true;
  double shortest = 0, longest = 0;
  for (std::size_t k = 0; k < low.size(); ++k) {
    period.origin_[k] = low[k];
    period.room_low_[k] = low[k];
    period.room_high_[k] = high[k];
    if (!axes[k]) continue;
    const auto next = static_cast<std::size_t>(period.count_++);
    period.periodic_[k] = period.rounded_[k] = true;
    period.given_[k][k] = period.vector_[next][k] = high[k] - low[k];
    period.of_given_[next][k] = 1;
    period.reach_[next] = 1;
    shortest = next == 0 ? high[k] - low[k] : std::min(shortest, high[k] - low[k]);
    longest = std::max(longest, high[k] - low[k]);
  }
  if (period.count_ == 0)
    refuse_period("a periodic box needs at least one periodic axis; use Domain::box for none");
  check_lengths(shortest, longest, "box");
  period.set_quanta();
  period.set_room();
  period.set_dual();
  period.measure_ = 1;
  for (std::size_t k = 0; k < low.size(); ++k) period.measure_ *= high[k] - low[k];
  period.set_grid();
  return period;
}

Period Period::of_lattice(std::span<const double> vectors, std::span<const double> origin) {
  const std::size_t d = origin.size();
  Period period;
  period.dimension_ = period.count_ = static_cast<int>(d);
  std::vector<LatticeVector> basis(d);
  double longest_given = 0, shortest = 0, longest = 0;
  for (std::size_t k = 0; k < d; ++k) {
    period.origin_[k] = origin[k];
    period.periodic_[k] = period.rounded_[k] = true;
    for (std::size_t c = 0; c < d; ++c) basis[k].x[c] = period.given_[k][c] = vectors[k * d + c];
    basis[k].of_given[k] = 1;
    longest_given = std::max(longest_given, length(period.given_[k]));
  }
  basis = reduced_basis(basis);
  if (basis.empty())
    refuse_period(
        "the vectors of the lattice are dependent, or so nearly that a shift along them would need more than "
        "2^20 of them; give " +
        std::to_string(d) + " independent ones, as short as possible");
  for (std::size_t k = 0; k < d; ++k) {
    for (std::size_t c = 0; c < d; ++c) period.vector_[k][c] = static_cast<double>(basis[k].x[c]);
    period.of_given_[k] = basis[k].of_given;
    const double here = length(period.vector_[k]);
    shortest = k == 0 ? here : std::min(shortest, here);
    longest = std::max(longest, here);
  }
  if (!(shortest > dependent * longest_given))
    refuse_period("the vectors of the lattice are dependent; give " + std::to_string(d) + " that span the " +
                  (d == 2 ? "plane" : "space"));
  check_lengths(shortest, longest, "lattice (of its reduced basis)");
  period.set_quanta();
  period.set_dual();
  for (std::size_t k = 0; k < d; ++k)
    for (std::size_t c = 0; c < d; ++c) basis[k].x[c] = period.vector_[k][c];
  const Coordinates extent = extent_of_voronoi_cell(basis, period.dual_);
  for (std::size_t k = 0; k < d; ++k) period.reach_[k] = 2 * extent[k];
  period.set_room();
  period.set_grid();
  return period;
}

void Period::set_grid() {
  grid_ = PeriodGrid({count_, is_box_, vector_, dual_, origin_, quantum_, of_given_});
}

/// The quantum of a coordinate is at most 2^-51 of the largest that an image may have.
/// \throw Error invalid_domain if rounding to it changes the lattice
void Period::set_quanta() {
  double shortest = length(vector(0)), change = 0;
  for (int k = 1; k < count_; ++k) shortest = std::min(shortest, length(vector(k)));
  for (std::size_t c = 0; c < 3; ++c) {
    quantum_[c] = 0;
    if (!rounded_[c]) continue;
    double most = std::fabs(origin_[c]);
    for (int k = 0; k < count_; ++k) most += (is_box_ ? 2 : 4) * std::fabs(vector(k)[c]);
    int exponent = 0;
    std::frexp(most, &exponent);
    quantum_[c] = std::ldexp(1.0, exponent - 52);
    for (int k = 0; k < count_; ++k) {
      const double exact = vector(k)[c];
      vector_[at(k)][c] = std::nearbyint(exact / quantum_[c]) * quantum_[c];
      change = std::max(change, std::fabs(vector(k)[c] - exact));
    }
  }
  if (!(change <= most_change * shortest))
    refuse_period(
        "the periodic domain lies so far from the origin that coordinates there are too coarse for its "
        "periods; move it, and the seeds with it, nearer to the origin");
}

/// Cells reach less than the sum of the vectors beyond those parts of the lattice that seeds are wrapped
/// into.
void Period::set_room() {
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension_); ++c) {
    if (!rounded_[c]) continue;
    double below = 0, above = 0, around = 0;
    for (int k = 0; k < count_; ++k) {
      below += std::min(vector(k)[c], 0.0);
      above += std::max(vector(k)[c], 0.0);
      around += std::fabs(vector(k)[c]);
    }
    room_low_[c] = (std::floor((origin_[c] + below - around) / quantum_[c])) * quantum_[c];
    room_high_[c] = (std::ceil((origin_[c] + above + around) / quantum_[c])) * quantum_[c];
  }
}

void Period::set_dual() {
  using Vector = Vector3<long double>;
  const auto wide = [&](int k) { return Vector{vector(k)[0], vector(k)[1], vector(k)[2]}; };
  if (count_ < dimension_ || dimension_ == 1) {
    for (int k = 0; k < count_; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        dual_[at(k)][c] = vector(k)[c] != 0 ? 1 / vector(k)[c] : 0;  // along an axis
  } else {
    const Vector a = wide(0), b = wide(1), c = dimension_ == 3 ? wide(2) : Vector{0, 0, 1};
    const long double volume = dot(a, cross(b, c));
    measure_ = static_cast<double>(std::fabs(volume));
    const Vector rows[3] = {1 / volume * cross(b, c), 1 / volume * cross(c, a), 1 / volume * cross(a, b)};
    for (int k = 0; k < count_; ++k)
      for (std::size_t x = 0; x < 3; ++x) dual_[at(k)][x] = static_cast<double>(rows[k][x]);
  }
  for (int k = 0; k < count_; ++k) spacing_[at(k)] = 1 / length(dual_[at(k)]);
}

Period::Coordinates Period::fraction(const double* x) const {
  Coordinates f{};
  for (int k = 0; k < count_; ++k)
    for (std::size_t c = 0; c < static_cast<std::size_t>(dimension_); ++c)
      f[at(k)] += dual_[at(k)][c] * (x[c] - origin_[c]);
  return f;
}

Period::Coordinates Period::moved(const double* x, const Shift& shift) const {
  Coordinates y{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension_); ++c) {
    double by = 0;
    for (int k = 0; k < count_; ++k) by += shift[at(k)] * vector(k)[c];
    y[c] = x[c] + by;
  }
  return y;
}

std::array<std::int64_t, 3> Period::as_given(const Shift& shift) const {
  std::array<std::int64_t, 3> given{};
  for (std::size_t m = 0; m < 3; ++m)
    for (int k = 0; k < count_; ++k) given[m] += shift[at(k)] * of_given_[at(k)][m];
  return given;
}

Period::Coordinates Period::sum_given(const Shift& shift) const {
  Coordinates sum{};
  for (std::size_t c = 0; c < 3; ++c) {
    long double x = 0;
    for (std::size_t k = 0; k < 3; ++k) x += static_cast<long double>(shift[k]) * given_[k][c];
    sum[c] = static_cast<double>(x);
  }
  return sum;
}

Period::Wrapped Period::wrap(const double* x) const {
  const PeriodGrid::Place place = grid_.wrap(x);
  Wrapped result{{}, {}, place.is_far};
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension_); ++c)
    result.position[c] = quantum_[c] > 0 ? static_cast<double>(place.at[c]) * quantum_[c] : x[c];
  for (std::size_t k = 0; k < 3; ++k) result.shift[k] = static_cast<std::int32_t>(place.shift[k]);
  return result;
}

std::size_t wrap_all(const Period& period, std::span<const double> positions, int threads,
                     std::span<double> wrapped, std::span<Shift> shift) {
  const auto d = static_cast<std::size_t>(period.dimension());
  return first_of(positions.size() / d, threads, [&](std::size_t i) {
    const Period::Wrapped at = period.wrap(&positions[i * d]);
    std::copy_n(at.position.begin(), d, &wrapped[i * d]);
    if (!shift.empty()) shift[i] = at.shift;
    return at.is_far;
  });
}

void refuse_far(std::size_t index) {
  throw Error(ErrorCode::invalid_seed, "seed " + std::to_string(index) + ": " + too_far_outside);
}

}  // namespace powercell
