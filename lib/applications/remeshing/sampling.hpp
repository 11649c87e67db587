/// \file
/// Seeds on a surface with their diagram: corners, seeds on kept curves, free ones.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "lib/applications/remeshing/curves.hpp"
#include "lib/applications/remeshing/local_diagram.hpp"
#include "lib/applications/remeshing/max_tree.hpp"
#include "lib/applications/remeshing/sizing.hpp"

namespace powercell::remeshing {

constexpr double weight_share =
    1.0 / 3;  ///< w = h^2/3: the vertices of a regular mesh of edge h have power 0

/// Where a seed may be.
struct Hold {
  enum class Kind : std::uint8_t { free, curve, corner };
  Kind kind = Kind::free;
  std::uint32_t curve = nothing;  ///< of kind curve
  double along = 0;               ///< length along that curve
  Place place;
};

/// A vertex of a cell.
struct FarPoint {
  Place place;
  double priority = -1e300;  ///< (|v - p_i|^2 - w_i) / h_i^2
};

/// Seeds and their cells. All weights follow from the sizing; each is moved by a random 10^-7 of itself, so
/// that seeds are in general position.
class Sampling {
 public:
  Sampling(const Surface& surface, const Sizing& sizing, std::vector<Curve> curves,
           std::uint64_t random_seed);

  /// Sets seeds on corners and curves. \throw Error invalid_argument if they are more than `most`
  void place_on_curves(std::size_t most);

  std::uint32_t add_free(const Place& place) { return add({Hold::Kind::free, nothing, 0, place}); }
  /// With the weight of the seed whose cell the place is in: neither hides the other, however near they are.
  std::uint32_t add_between(const Place& place) { return add_between({Hold::Kind::free, nothing, 0, place}); }
  /// Gives a seed that is outside its own cell the weight of the seed in whose cell it is. Returns whether it
  /// is in its own then.
  bool give_cell(std::uint32_t seed);
  void remove(std::uint32_t seed);
  /// A seed in the middle between two neighbours on a curve (by rank in `on_curve`), weighed as add_between.
  std::uint32_t split(std::uint32_t curve, std::size_t rank);

  /// The vertex of the cells that is farthest from its seed, of those outside the balls around neighbours
  /// on curves; priority -1e300 if there is none.
  FarPoint farthest() const;
  /// That of one cell.
  FarPoint farthest_of(std::uint32_t seed) const;

  const LocalDiagram& diagram() const { return diagram_; }
  const Hold& hold(std::uint32_t seed) const { return hold_[seed]; }
  std::size_t curve_count() const { return curves_.size(); }
  const Curve& curve(std::uint32_t c) const { return curves_[c]; }
  /// Seeds along a curve, in order; those at its ends too, of a closed one the first again at the end.
  const std::vector<std::uint32_t>& on_curve(std::uint32_t c) const { return on_curve_[c]; }
  std::vector<std::uint32_t> free_seeds() const;
  /// The seed whose cell the place is in.
  std::uint32_t owner(const Place& place) const;
  /// Least distance to a neighbour over h, of all seeds.
  double least_spacing() const;
  double sizing_at(const Place& place) const { return sizing_.at(surface_, place); }
  std::mt19937_64& random() { return random_; }

 private:
  std::uint32_t add(const Hold& hold);
  std::uint32_t add(const Hold& hold, double weight, double h);
  std::uint32_t add_between(const Hold& hold);
  std::uint32_t corner_seed(std::uint32_t vertex, const Place& place);
  void measure_changed();
  void link_curve(std::uint32_t c);
  bool in_curve_ball(std::uint32_t seed, Vec x) const;

  const Surface& surface_;
  const Sizing& sizing_;
  std::vector<Curve> curves_;
  LocalDiagram diagram_;
  std::vector<Hold> hold_;
  std::vector<std::vector<std::uint32_t>> on_curve_;
  std::vector<std::vector<std::uint32_t>> chord_;  ///< per seed: its neighbours on curves
  std::vector<std::uint32_t> corner_of_vertex_;
  std::vector<FarPoint> far_;
  MaxTree heap_;
  std::mt19937_64 random_;
};

}  // namespace powercell::remeshing
