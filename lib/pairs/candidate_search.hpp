/// \file
/// The candidates of one region, or of a box of regions. Internal.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "lib/pairs/exclusion.hpp"
#include "lib/pairs/frontier.hpp"
#include "lib/pairs/local_tree.hpp"
#include "lib/pairs/part.hpp"
#include "lib/pairs/region_interior.hpp"

namespace powercell::pairs {

/// One worker's search with its scratch memory; not thread-safe.
template <int D>
class CandidateSearch {
 public:
  CandidateSearch(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, double reference)
      : mesh_(mesh), tree_(seeds, tree, reference) {}

  /// From the seeds in `from`, those that can meet the box [low, high], as a frontier fine enough to begin
  /// a search with.
  void narrow(const Point<D>& low, const Point<D>& high, const Frontier& from, Frontier& to);

  /// Appends to `ranks` the candidates of `region`, ascending, among the seeds in `from`.
  void find(std::uint32_t region, const Frontier& from, std::vector<std::uint32_t>& ranks);

 private:
  struct Step {
    Part<D> part;
    PowerBounds bounds;
    Testers testers;
    Frontier frontier;
    std::uint64_t open = 0;  // seeds below entries that are not settled
  };
  struct Halves {
    Step first, second;
  };

  void set_region(std::uint32_t region);
  void search_polygon(std::span<const Point<D>> corners, const Frontier& from);
  void search(Step& step);
  void visit(Step& step, std::size_t depth, int failures);
  void refine(Step& step, const Frontier& from, const Testers& known, std::size_t enough, bool settle);
  void choose_testers(Step& step, const Frontier& from, const Testers& known);
  void take(Step& step, Entry entry, bool settle, bool fresh);
  void expand(Step& step, std::size_t enough, bool settle);
  void finish(Step& step);
  void finish_few(Step& step);
  void emit(RankRange range) { found_.push_back(range); }

  const RegionMesh& mesh_;
  LocalTree<D> tree_;
  std::vector<Point<D>> corners_;  // of the region, relative to its first
  double reach_ = 0;               // largest distance of a corner from the first
  RegionInterior<D> interior_;
  std::uint64_t steps_left_ = 0;
  std::vector<RankRange> found_;

  Step root_;
  std::deque<Halves> halves_;  // by depth; references stay valid as it grows
  Frontier expanding_;
  std::vector<std::uint32_t> few_;
  std::vector<CornerValues> few_lower_, few_upper_;
};

extern template class CandidateSearch<2>;
extern template class CandidateSearch<3>;

}  // namespace powercell::pairs
