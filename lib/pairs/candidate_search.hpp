/// \file
/// The candidates of one region, or of a box of regions.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "lib/pairs/exclusion.hpp"
#include "lib/pairs/list_search.hpp"
#include "lib/pairs/local_tree.hpp"
#include "lib/pairs/pair_finder.hpp"
#include "lib/pairs/part.hpp"
#include "lib/pairs/region_interior.hpp"
#include "lib/regions/region_groups.hpp"

namespace powercell::pairs {

/// The seeds that can meet a box: those below a frontier or, once they are few, those of a list.
template <int D>
struct Narrowed {
  Frontier frontier;
  SeedList<D> list;
  bool listed = false;
};

/// The search of one thread, with its scratch memory.
template <int D>
class CandidateSearch {
 public:
  CandidateSearch(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, double reference)
      : mesh_(mesh),
        seeds_(seeds),
        reference_(reference),
        tree_(seeds, tree, reference),
        node_search_(tree_) {}

  /// Sets `to` to the seeds of `from` that can meet the box [low, high], fine enough to start a search from.
  void narrow(const Point<D>& low, const Point<D>& high, const Narrowed<D>& from, Narrowed<D>& to);

  /// Appends the candidates of `region` among the seeds of `from` to `ranks`, ascending.
  void find(std::uint32_t region, const Narrowed<D>& from, std::vector<std::uint32_t>& ranks);

 private:
  struct Step {
    Part<D> part;
    PowerBounds bounds;
    Testers testers;
    Frontier frontier;
    std::uint64_t undecided = 0;  // seeds below entries that are not yet accepted
  };
  struct Halves {
    Step first, second;
  };

  void set_region(std::uint32_t region);
  template <class Body>
  void for_parts(std::span<const Point<D>> corners, const Body& body);
  void search(const Frontier& from);
  void gather(const Frontier& frontier, SeedList<D>& list);
  void visit(Step& step, std::size_t depth, int failures);
  void refine(Step& step, const Frontier& from, const Testers& known, std::size_t min_entries);
  void choose_testers(Step& step, const Frontier& from, const Testers& known);
  void keep_unless_excluded(Step& step, Entry entry, bool is_new);
  void expand(Step& step, std::size_t min_entries);
  void finish(Step& step);

  const RegionMesh& mesh_;
  const SeedSet& seeds_;
  const double reference_;
  LocalTree<D> tree_;
  NodeSearch<D> node_search_;
  std::vector<Point<D>> corners_;   // of the region, relative to the first
  const double* origin_ = nullptr;  // the first corner
  double reach_ = 0;                // largest distance of a corner from the first
  RegionInterior<D> interior_;
  std::uint64_t steps_left_ = 0;
  std::vector<RankRange> found_;

  Step root_;
  std::deque<Halves> halves_;  // by depth; references stay valid as it grows
  Frontier expanding_;
  std::vector<RankRange> gathered_;
  std::vector<CornerValues> testers_;
  std::vector<std::uint32_t> ranks_;
  SeedList<D> few_;
  ListSearch<D> list_search_;
};

extern template class CandidateSearch<2>;
extern template class CandidateSearch<3>;

/// Everything must outlive the search.
struct RegionSearchInput {
  const RegionMesh& mesh;
  const RegionGroups& groups;
  const SeedSet& seeds;
  const PackedTree& tree;
  int threads;
  const std::function<bool(double)>& progress;
};

/// A view of the candidate ranks of one region, ascending.
struct RankList {
  const std::uint32_t* first = nullptr;
  std::uint32_t count = 0;
};

/// The candidates found. The lists point into `tasks`.
struct RegionLists {
  struct Task {
    std::vector<std::uint32_t> ranks;  ///< region after region in the order of the groups
    std::vector<std::uint64_t> end;    ///< per region: end of its ranks
  };
  std::vector<Task> tasks;
  std::vector<RankList> list;  ///< by region
};

/// \throw Error interrupted
RegionLists search_regions(const RegionSearchInput& search);

}  // namespace powercell::pairs
