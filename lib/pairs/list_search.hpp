/// \file
/// Exact exclusion among few seeds, all at once. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "lib/pairs/exclusion.hpp"
#include "lib/pairs/part.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell::pairs {

/// Columns 0 .. D-1 are coordinates, column D is the weight.
template <int D>
using SeedColumns = std::array<std::vector<double>, D + 1>;

/// Seeds by ascending rank, with coordinates as given and weights relative to a reference.
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
  /// Becomes the seeds of `from` at these places.
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

/// One worker's search with its scratch memory; not thread-safe. The powers of all seeds at each corner of a
/// part are a column: a part that is split inherits those of the corners that stay.
template <int D>
class ListSearch {
 public:
  /// The seeds of `from` that can meet the box [low, high].
  void narrow(const Point<D>& low, const Point<D>& high, const SeedList<D>& from, SeedList<D>& to);

  /// Begins with a region: coordinates will be relative to `origin`, `reach` is as in PowerBounds.
  /// Keeps a reference to `seeds`.
  void begin(const SeedList<D>& seeds, const double* origin, double reach);
  /// Marks the seeds that can meet the part.
  /// \param known  excludes as well, by upper bounds at the corners of the part
  void search(const Part<D>& part, std::span<const CornerValues> known = {});
  /// Appends the marked ranks, ascending.
  void append_marked(std::vector<std::uint32_t>& ranks) const;

 private:
  struct Level {
    Part<D> part;
    std::vector<std::uint32_t> index;                     // into the list
    SeedColumns<D> local;                                 // coordinates relative to the origin
    std::array<std::vector<double>, most_corners> lower;  // bounds of the powers at the corners
    std::size_t count() const { return index.size(); }
  };
  struct Halves {
    Level first, second;
  };

  /// Seeds to be narrowed down: a whole list, or those of a level.
  struct Source {
    std::size_t count;
    std::array<const double*, D + 1> column;
    const double* origin;  // of the columns
    const Level* level;    // or none
  };
  static Source source_of(const Level& level);

  std::size_t owner_of(const Point<D>& x, const Source& from);
  void visit(Level& level, std::size_t depth, int failures);
  /// Fills `half`, whose part is set, with what can meet it.
  void narrow_to(const Source& from, std::span<const CornerValues> known, Level& half);
  void find_bounds(const Source& from, const Part<D>& part);
  void add_tester(const Source& from, const Part<D>& part, std::size_t seed);
  void keep_unexcluded(const Source& from, Level& half);
  void finish(Level& level);

  const SeedList<D>* seeds_ = nullptr;
  std::vector<unsigned char> marked_;
  Source all_{};
  SeedList<D> near_;
  PowerBounds bounds_;
  double reach_ = 0;
  std::deque<Halves> halves_;  // by depth; references stay valid as it grows
  Level root_;
  std::vector<double> power_, excess_;
  std::vector<std::uint32_t> tester_, kept_;
  std::array<std::vector<double>, most_corners> fresh_;
  std::array<const double*, most_corners> lower_{};
};

extern template class ListSearch<2>;
extern template class ListSearch<3>;

}  // namespace powercell::pairs
