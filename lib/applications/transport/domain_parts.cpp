#include "lib/applications/transport/domain_parts.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <powercell/regions.hpp>

#include "lib/base/disjoint_sets.hpp"

namespace powercell {

DomainParts domain_parts(const Domain& domain) {
  const RegionsView view = domain.regions();
  DisjointSets sets(view.size());
  for (std::uint32_t r = 0; r < view.size(); ++r)
    for (std::uint32_t f = view.facet_offset[r]; f < view.facet_offset[r + 1]; ++f)
      if (view.facet[f].kind == Border::Kind::interior) sets.unite(r, view.facet[f].index);
  DomainParts parts;
  if (domain.is_solid()) {  // which bodies are connected is not known
    parts.count = 1;
    parts.of_region = {0};
    return parts;
  }
  parts.of_region.resize(view.size());
  for (std::uint32_t r = 0; r < view.size(); ++r) {
    const std::uint32_t root = sets.root(r);  // the least of its set
    parts.of_region[r] = root == r ? parts.count++ : parts.of_region[root];
  }
  return parts;
}

void join_small(DomainParts& parts, const DomainPoints& points, std::uint32_t most) {
  if (parts.count <= most) return;
  const std::size_t d = points.points.positions.size() / points.points.size();
  std::vector<double> mass(parts.count), center(parts.count * d);
  for (std::size_t k = 0; k < points.points.size(); ++k) {
    const std::uint32_t part = parts.of_region[points.region[k]];
    mass[part] += points.points.mass[k];
    for (std::size_t c = 0; c < d; ++c)
      center[part * d + c] += points.points.mass[k] * points.points.positions[k * d + c];
  }
  for (std::size_t k = 0; k < center.size(); ++k) center[k] /= mass[k / d];
  std::vector<std::uint32_t> order(parts.count), number(parts.count);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, std::greater<>(), [&](std::uint32_t k) { return mass[k]; });
  const auto nearest = [&](std::uint32_t part) {
    std::uint32_t to = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t j = 0; j < most; ++j) {
      double square = 0;
      for (std::size_t c = 0; c < d; ++c) {
        const double q = center[order[j] * d + c] - center[part * d + c];
        square += q * q;
      }
      if (square < least) {
        least = square;
        to = j;
      }
    }
    return to;
  };
  for (std::uint32_t k = 0; k < order.size(); ++k) number[order[k]] = k < most ? k : nearest(order[k]);
  for (std::uint32_t& part : parts.of_region) part = number[part];
  parts.count = most;
}

}  // namespace powercell
