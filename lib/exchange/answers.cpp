#include "lib/exchange/answers.hpp"

#include <algorithm>

#include "lib/base/threads.hpp"
#include "lib/exchange/boundary_leaves.hpp"
#include "lib/exchange/cut_test.hpp"
#include "lib/exchange/tree_walk.hpp"

namespace powercell::exchange {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};
/// Steps towards the seed of a cell; each is to a seed of lower power, so that few are taken.
constexpr int most_steps = 64;
/// A step must shorten the way by more than the rounding of a crossing.
constexpr double least_step = 1 - 1e-9;
/// So many are faster to test one by one than to find in the tree.
constexpr std::size_t few_leaves = 32;
/// Fewer are faster on one thread.
constexpr std::size_t least_shared = 2048 /* vertices */, least_shared_leaves = 512;

/// Searches for the vertices of one cell after the other.
class VertexSearch {
 public:
  VertexSearch(const TreeSeeds& seeds, const MaySend& may_send) : seeds_(seeds), may_send_(may_send) {}

  /// Answers the vertices of a cell.
  /// \param ranks  receives those to send
  void answer(const Request& request, std::size_t cell, std::vector<std::uint8_t>& found,
              std::vector<std::uint32_t>& ranks) {
    const std::size_t d = seeds_.dimension();
    const double* const row = &request.cell[cell * (d + 2)];
    const double radius = row[d + 1];
    CutTest point(row, radius, seeds_.tree.dimension);
    find_leaves(point);
    for (std::uint32_t v = cell == 0 ? 0 : request.end[cell - 1]; v < request.end[cell]; ++v) {
      Point y{};
      for (std::size_t k = 0; k < d; ++k) y[k] = radius * static_cast<double>(request.vertex[v * d + k]);
      point.move_to(y);
      if (find_first(point, ranks)) found[v] = 1;
    }
  }

 private:
  /// Lists the leaves that could cut the cell, if they are few.
  void find_leaves(const CutTest& cell) {
    const PackedTree& tree = seeds_.tree;
    const std::size_t d = seeds_.dimension();
    leaves_.clear();
    few_ = true;
    visit_leaves(
        tree,
        [&](std::uint32_t node) {
          return cell.may_meet(&tree.low[node * d], &tree.high[node * d], tree.weight[node]);
        },
        [&](std::uint32_t leaf) {
          leaves_.push_back(leaf);
          few_ = leaves_.size() <= few_leaves;
          return few_;
        });
  }

  /// The rank of least power at a point, of seeds that may cut it and may be sent, or none.
  std::uint32_t least(const CutTest& point) const {
    const PackedTree& tree = seeds_.tree;
    const std::size_t d = seeds_.dimension();
    double limit = point.limit();
    std::uint32_t best = none;
    const auto key = [&](std::uint32_t node) {
      return point.power(&tree.low[node * d], &tree.high[node * d], tree.weight[node]);
    };
    const auto look_into = [&](std::uint32_t leaf) {
      for (std::size_t rank = seeds_.first_of(leaf); rank < seeds_.first_of(leaf + std::size_t{1}); ++rank) {
        const double power = point.power(seeds_.position(rank), seeds_.weights[rank]);
        if (power > limit || !may_send_(static_cast<std::uint32_t>(rank))) continue;
        limit = power;
        best = static_cast<std::uint32_t>(rank);
      }
    };
    if (!few_) {
      visit_nearest(tree, key, limit, look_into);
      return best;
    }
    for (const std::uint32_t leaf : leaves_)
      if (!(key(leaf) > limit)) look_into(leaf);
    return best;
  }

  /// Appends the rank that a vertex is answered with.
  /// \return whether there is any
  bool find_first(CutTest& point, std::vector<std::uint32_t>& ranks) const {
    std::uint32_t first = least(point);
    if (first == none) return false;
    const Point vertex = point.at();
    double along = 1;
    for (int step = 0; step < most_steps; ++step) {
      point.move_to(vertex);
      const double crossing = point.crossing(seeds_.position(first), seeds_.weights[first]);
      if (!(crossing > 0) || !(crossing < along * least_step)) break;
      along = crossing;
      point.move_to({along * vertex[0], along * vertex[1], along * vertex[2]});
      const std::uint32_t next = least(point);
      if (next == none || next == first) break;
      // It may cut the cell on the side of the seed alone, if the seed is not in it. To leave it out and send
      // the one before would fetch more seeds: a fifth more of white seeds with weights W2.
      first = next;
    }
    ranks.push_back(first);
    return true;
  }

  TreeSeeds seeds_;
  const MaySend& may_send_;
  std::vector<std::uint32_t> leaves_;  // that could cut the present cell
  bool few_ = false;                   // whether these are all; else the tree is searched
};

std::vector<std::uint32_t> joined(const std::vector<std::vector<std::uint32_t>>& parts) {
  std::vector<std::uint32_t> all;
  for (const std::vector<std::uint32_t>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

std::vector<std::uint32_t> ranks_near(const TreeSeeds& seeds, const BoundaryLeaves& boundary, int threads,
                                      std::pair<std::size_t, std::size_t> own) {
  std::vector<std::vector<std::uint32_t>> found(boundary.leaves());
  parallel_for(threads_for(found.size(), threads, least_shared_leaves), found.size(),
               [&](std::size_t begin, std::size_t end) {
                 NearBoundary near(seeds, own);
                 for (std::size_t k = begin; k < end; ++k) near.find(boundary, k, found[k]);
               });
  std::vector<std::uint32_t> ranks = joined(found);
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

FirstSeeds first_seeds(const TreeSeeds& seeds, const Request& request, const MaySend& may_send, int threads) {
  FirstSeeds first;
  first.found.resize(request.vertex.size() / seeds.dimension());
  std::vector<std::vector<std::uint32_t>> ranks(request.cells());
  parallel_for(threads_for(first.found.size(), threads, least_shared), request.cells(),
               [&](std::size_t begin, std::size_t end) {
                 VertexSearch search(seeds, may_send);
                 for (std::size_t cell = begin; cell < end; ++cell)
                   search.answer(request, cell, first.found, ranks[cell]);
               });
  first.rank = joined(ranks);
  return first;
}

}  // namespace powercell::exchange
