#include "lib/domain/reduce_basis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/base/vectors.hpp"

namespace powercell {
namespace {

using Vector = Vector3<long double>;

/// Rounding of inner products, relative to the lengths.
constexpr long double rounding = 64 * std::numeric_limits<long double>::epsilon();
constexpr int most_steps = 4096;
constexpr std::int64_t most_factor = std::int64_t{1} << 20;  ///< of a vector as given

/// `other` may be `to`.
void add(LatticeVector& to, const LatticeVector& other, std::int64_t factor) {
  to.x = to.x + static_cast<long double>(factor) * other.x;
  for (std::size_t k = 0; k < 3; ++k) to.of_given[k] += factor * other.of_given[k];
}

/// Shortens vectors by multiples of others, as Euclid's algorithm does, so that few of the steps below
/// remain. False if factors become too large.
bool shorten(std::vector<LatticeVector>& basis) {
  for (bool changed = true; changed;) {
    changed = false;
    for (LatticeVector& v : basis)
      for (const LatticeVector& by : basis) {
        if (&v == &by || !(dot(by.x, by.x) > 0) || dot(v.x, v.x) < dot(by.x, by.x)) continue;
        const long double factor = std::round(dot(v.x, by.x) / dot(by.x, by.x));
        if (factor == 0) continue;
        if (!(std::fabs(factor) <= most_factor)) return false;
        const LatticeVector before = v;
        add(v, by, -static_cast<std::int64_t>(factor));
        for (const std::int64_t of : v.of_given)
          if (of > most_factor || of < -most_factor) return false;
        if (!(dot(v.x, v.x) < dot(before.x, before.x))) {
          v = before;
          continue;
        }
        changed = true;
      }
  }
  return true;
}

/// One step of the reduction; false if no inner product is positive. The sum of the squares falls by a
/// multiple of the product.
bool reduce_once(std::vector<LatticeVector>& super) {
  for (std::size_t i = 0; i < super.size(); ++i)
    for (std::size_t j = i + 1; j < super.size(); ++j) {
      const long double product = dot(super[i].x, super[j].x);
      if (!(product > rounding * norm(super[i].x) * norm(super[j].x))) continue;
      // The others take what the sum loses: twice vector i for one other, once for each of two.
      for (std::size_t k = 0; k < super.size(); ++k)
        if (k != i && k != j) add(super[k], super[i], super.size() == 3 ? 2 : 1);
      add(super[i], super[i], -2);
      return true;
    }
  return false;
}

/// The sums of non-empty subsets of the basis.
std::vector<Vector> subset_sums(const std::vector<LatticeVector>& basis) {
  std::vector<Vector> sums;
  for (unsigned subset = 1; subset < 1U << basis.size(); ++subset) {
    Vector sum{};
    for (std::size_t k = 0; k < basis.size(); ++k)
      if ((subset >> k & 1) != 0) sum = sum + basis[k].x;
    sums.push_back(sum);
  }
  return sums;
}

/// Calls use(y) for the points where `dimension` planes of the Voronoi cell meet.
template <class Use>
void for_meeting_points(const std::vector<Vector>& normal, std::size_t dimension, const Use& use) {
  const auto half = [](const Vector& n) { return dot(n, n) / 2; };
  const std::size_t count = normal.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      if (dimension == 2) {
        const Vector &a = normal[i], &b = normal[j];
        const long double d = a[0] * b[1] - a[1] * b[0];
        if (d != 0) use({(half(a) * b[1] - half(b) * a[1]) / d, (half(b) * a[0] - half(a) * b[0]) / d, 0});
        continue;
      }
      for (std::size_t k = j + 1; k < count; ++k) {
        const Vector &a = normal[i], &b = normal[j], &c = normal[k];
        const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
        const long double d = dot(a, bc);
        if (std::fabs(d) > rounding * norm(a) * norm(b) * norm(c))
          use(1 / d * (half(a) * bc + half(b) * ca + half(c) * ab));
      }
    }
}

}  // namespace

std::vector<LatticeVector> reduced_basis(std::vector<LatticeVector> basis) {
  if (!shorten(basis)) return {};
  LatticeVector rest;
  for (const LatticeVector& v : basis) add(rest, v, -1);
  basis.push_back(rest);
  for (int step = 0; step < most_steps && reduce_once(basis); ++step) {
  }
  // The longest one is the one to do without.
  const auto longest = std::max_element(
      basis.begin(), basis.end(), [](const auto& a, const auto& b) { return dot(a.x, a.x) < dot(b.x, b.x); });
  basis.erase(longest);
  return basis;
}

std::array<double, 3> extent_of_voronoi_cell(const std::vector<LatticeVector>& basis,
                                             const std::array<std::array<double, 3>, 3>& dual) {
  constexpr long double slack = 1e-9L;
  std::vector<Vector> normal;
  for (const Vector& sum : subset_sums(basis)) {
    normal.push_back(sum);
    normal.push_back(-1.0L * sum);
  }
  std::array<double, 3> extent{};
  for_meeting_points(normal, basis.size(), [&](const Vector& y) {
    for (const Vector& n : normal)
      if (dot(n, y) > (1 + slack) * dot(n, n) / 2) return;
    for (std::size_t k = 0; k < basis.size(); ++k) {
      const Vector f{dual[k][0], dual[k][1], dual[k][2]};
      extent[k] = std::max(extent[k], static_cast<double>(std::fabs(dot(f, y))));
    }
  });
  return extent;
}

}  // namespace powercell
