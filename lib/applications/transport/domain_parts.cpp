#include "lib/applications/transport/domain_parts.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <powercell/regions.hpp>

#include "lib/applications/transport/cell_simplices.hpp"
#include "lib/base/disjoint_sets.hpp"

namespace powercell {

DomainParts domain_parts(const Domain& domain) {
  const RegionsView view = domain.regions();
  DisjointSets sets(view.size());
  for (std::uint32_t r = 0; r < view.size(); ++r)
    for (std::uint32_t f = view.facet_offset[r]; f < view.facet_offset[r + 1]; ++f)
      if (view.facet[f].kind == Border::Kind::interior) sets.unite(r, view.facet[f].index);
  DomainParts parts;
  parts.of_region.resize(view.size());
  for (std::uint32_t r = 0; r < view.size(); ++r) {
    const std::uint32_t root = sets.root(r);  // the least of its set
    parts.of_region[r] = root == r ? parts.count++ : parts.of_region[root];
  }
  return parts;
}

std::vector<std::vector<PartOfCell>> parts_of_cells(const Cells& cells, std::span<const double> mass,
                                                    const DomainParts& parts) {
  const CellSimplices all = cut_into_simplices(cells, mass);
  std::vector<std::vector<PartOfCell>> result(cells.cell_count());
  std::vector<std::pair<std::uint32_t, NormalSum>> sums;
  for (std::size_t k = 0; k < all.simplex.size();) {
    const std::uint32_t cell = all.simplex[k].cell;
    sums.clear();
    for (; k < all.simplex.size() && all.simplex[k].cell == cell; ++k) {
      const CellSimplex& s = all.simplex[k];
      if (!(s.mass > 0)) continue;
      const std::uint32_t part = parts.of_region[cells.region[s.piece]];
      auto found = std::ranges::find(sums, part, &std::pair<std::uint32_t, NormalSum>::first);
      const auto corner = [&](int c) {
        const auto& x = all.vertex[s.vertex[static_cast<std::size_t>(c)]];
        return Place(x[0], x[1], x[2]);
      };
      if (found == sums.end()) found = sums.emplace(found, part, NormalSum(corner(0)));
      // The mean of x xᵀ with corners v and their sum t: (Σ v vᵀ + t tᵀ) / (c (c + 1)) for c corners.
      const Place origin = found->second.origin();
      Place total = Place::Zero();
      Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
      for (int c = 0; c < s.corners; ++c) {
        const Place v = corner(c) - origin;
        total += v;
        square += v * v.transpose();
      }
      square += total * total.transpose();
      found->second.add(s.mass, total / s.corners, square / (s.corners * (s.corners + 1)));
    }
    for (const auto& [part, sum] : sums) result[cell].push_back({part, sum.mass(), sum.normal()});
  }
  return result;
}

void join_small(DomainParts& parts, const std::vector<PartOfCell>& whole, std::uint32_t most) {
  if (whole.size() <= most) return;
  std::vector<std::uint32_t> order(whole.size()), number(parts.count);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, std::greater<>(), [&](std::uint32_t k) { return whole[k].mass; });
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    std::uint32_t to = k;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t j = 0; k >= most && j < most; ++j) {
      const double square = (whole[order[j]].where.mean - whole[order[k]].where.mean).squaredNorm();
      if (square < least) {
        least = square;
        to = j;
      }
    }
    number[whole[order[k]].part] = to;
  }
  for (std::uint32_t& part : parts.of_region) part = number[part];
  parts.count = most;
}

}  // namespace powercell
