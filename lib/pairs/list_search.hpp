/// \file
/// The seeds of a list that can meet a box or region.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "lib/pairs/exclusion.hpp"
#include "lib/pairs/local_tree.hpp"
#include "lib/pairs/part.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell::pairs {

/// Columns 0 .. D-1 are coordinates, column D is the weight.
template <int D>
using SeedColumns = std::array<std::vector<double>, D + 1>;

/// Seeds by ascending rank, with absolute coordinates, and weights relative to a reference.
template <int D>
struct SeedList {
  std::vector<std::uint32_t> rank;
  SeedColumns<D> column;

  std::size_t size() const { return rank.size(); }
  void clear() {
    rank.clear();
    for (std::vector<double>& c : column) c.clear();
  }
  void add(const SeedSet& seeds, std::uint32_t r, double reference) {
    rank.push_back(r);
    for (std::size_t k = 0; k < D; ++k) column[k].push_back(seeds.positions[std::size_t{r} * D + k]);
    column[D].push_back(seeds.weights[r] - reference);
  }
  /// Sets this to the seeds of `from` at these places.
  void pick(const SeedList& from, const std::vector<std::uint32_t>& place) {
    const std::size_t count = place.size();
    rank.resize(count);
    for (std::size_t s = 0; s < count; ++s) rank[s] = from.rank[place[s]];
    for (std::size_t k = 0; k <= D; ++k) {
      column[k].resize(count);
      for (std::size_t s = 0; s < count; ++s) column[k][s] = from.column[k][place[s]];
    }
  }
};

/// The search of one thread, with its scratch memory. The power distances of all seeds at a corner of a part
/// are a column; the halves of a split part inherit the columns of common corners.
template <int D>
class ListSearch {
 public:
  /// Sets `to` to the seeds of `from` that can meet the box [low, high].
  void narrow(const Point<D>& low, const Point<D>& high, const SeedList<D>& from, SeedList<D>& to);

  /// Starts with a region. Keeps a reference to `seeds`.
  /// \param origin  of coordinates in search()
  /// \param reach   as in PowerBounds
  void begin(const SeedList<D>& seeds, const double* origin, double reach);
  /// Marks the seeds that can meet the part.
  /// \param known  upper bounds of further testers at the corners of the part
  void search(const Part<D>& part, std::span<const CornerValues> known = {});
  /// Appends the marked ranks, ascending.
  void append_marked(std::vector<std::uint32_t>& ranks) const;

 private:
  /// The seeds that can meet a part.
  struct Subset {
    Part<D> part;
    std::vector<std::uint32_t> index;                     // into the list
    SeedColumns<D> local;                                 // coordinates relative to the origin
    std::array<std::vector<double>, most_corners> lower;  // bounds of the powers at the corners
    std::size_t count() const { return index.size(); }
  };
  struct Halves {
    Subset first, second;
  };

  /// Seeds to search: a whole list, or those of a subset.
  struct Source {
    std::size_t count;
    std::array<const double*, D + 1> column;
    const double* origin;  // of the columns
    const Subset* subset;  // null for a list
  };
  static Source source_of(const Subset& subset);

  std::size_t owner_of(const Point<D>& x, const Source& from);
  void visit(Subset& subset, std::size_t depth, int failures);
  /// Sets the seeds of `half` to those of `from` that can meet its part.
  void narrow_to(const Source& from, std::span<const CornerValues> known, Subset& half);
  void find_bounds(const Source& from, const Part<D>& part);
  void add_tester(const Source& from, const Part<D>& part, std::size_t seed);
  void keep_unexcluded(const Source& from, Subset& half);
  void finish(Subset& subset);

  const SeedList<D>* seeds_ = nullptr;
  std::vector<unsigned char> marked_;
  Source all_{};
  SeedList<D> near_;
  PowerBounds bounds_;
  double reach_ = 0;
  std::deque<Halves> halves_;  // by depth; references stay valid as it grows
  Subset root_;
  std::vector<double> power_, excess_;
  std::vector<std::uint32_t> tester_, kept_;
  std::array<std::vector<double>, most_corners> fresh_;
  std::array<const double*, most_corners> lower_{};
};

extern template class ListSearch<2>;
extern template class ListSearch<3>;

/// The search of one thread, with its scratch memory.
template <int D>
class NodeSearch {
 public:
  /// Keeps a reference to the tree, and changes its origin.
  explicit NodeSearch(LocalTree<D>& tree) : tree_(tree) {}

  /// Sets `to` to the nodes of one level below `from` that hold all seeds that can meet the box [low, high]:
  /// the highest level with at least `min_nodes` such nodes or at most `max_seeds` seeds below them.
  /// \param from  nodes of one level
  /// \return the number of seeds below `to`
  std::uint64_t narrow(const Point<D>& low, const Point<D>& high, const Frontier& from, std::size_t min_nodes,
                       std::uint64_t max_seeds, Frontier& to);

 private:
  void choose_testers(const Point<D>& size, const Frontier& from);
  void keep_unexcluded(const Point<D>& size, Frontier& nodes);
  std::uint64_t seeds_below(const Frontier& nodes) const;

  LocalTree<D>& tree_;
  std::vector<std::uint32_t> tester_;
  std::array<std::vector<double>, 2 * D + 1> column_;  // low and high coordinates, largest weight
  std::vector<double> excess_;
};

extern template class NodeSearch<2>;
extern template class NodeSearch<3>;

}  // namespace powercell::pairs
