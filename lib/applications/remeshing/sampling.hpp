/// \file
/// Seeds on a surface with their power diagram: at corners, on kept curves, and free.
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

/// w = h^2/3: the cell vertices of a regular mesh then have power 0.
constexpr double weight_share = 1.0 / 3;

/// The position of a seed and how it is constrained: free on the surface, on a curve, or at a corner.
struct Hold {
  enum class Kind : std::uint8_t { free, curve, corner };
  Kind kind = Kind::free;
  std::uint32_t curve = nothing;  ///< for kind curve
  double along = 0;               ///< length along that curve
  Place place;
};

/// A vertex of a cell.
struct FarPoint {
  Place place;
  double priority = -1e300;  ///< (|v - p_i|^2 - w_i) / h_i^2
};

/// Seeds and their cells. The weights follow from the sizing; each is changed by a random 10^-7 of itself,
/// which brings the seeds into general position.
class Sampling {
 public:
  /// Surface and sizing are kept by reference.
  Sampling(const Surface& surface, const Sizing& sizing, std::vector<Curve> curves,
           std::uint64_t random_seed);

  /// Places seeds at corners and along curves.
  /// \throw Error invalid_argument if they are more than `most`
  void place_on_curves(std::size_t most);

  /// Adds a free seed with the weight of the sizing. Like the functions below, returns its index.
  std::uint32_t add_free(const Place& place) { return add({Hold::Kind::free, nothing, 0, place}); }
  /// Adds a free seed with the weight of the seed whose cell contains the place, so that neither hides the
  /// other however close they are.
  /// \return `nothing` if they are so close that rounding decides between them; no seed is added then
  std::uint32_t add_between(const Place& place);
  /// Gives a seed outside its own cell the weight of the seed whose cell contains it.
  /// \return whether it is in its own cell now
  bool give_cell(std::uint32_t seed);
  void remove(std::uint32_t seed);
  /// Adds a seed halfway between two neighbours on a curve, the first of rank `rank` in on_curve(), with a
  /// weight as in add_between().
  std::uint32_t split(std::uint32_t curve, std::size_t rank);
  /// Whether those neighbours are not so close that rounding decides between them and a seed halfway.
  bool can_split(std::uint32_t curve, std::size_t rank) const;

  /// The cell vertex with the highest priority, excluding those in the balls over chords of curves; triangle
  /// `nothing` if there is none.
  FarPoint farthest() const;
  /// The same for one cell.
  FarPoint farthest_of(std::uint32_t seed) const;

  const LocalDiagram& diagram() const { return diagram_; }
  const Hold& hold(std::uint32_t seed) const { return hold_[seed]; }
  std::size_t curve_count() const { return curves_.size(); }
  const Curve& curve(std::uint32_t c) const { return curves_[c]; }
  /// Seeds along a curve, in order, including both ends; if it is closed, the first is repeated at the end.
  const std::vector<std::uint32_t>& on_curve(std::uint32_t c) const { return on_curve_[c]; }
  std::vector<std::uint32_t> free_seeds() const;
  /// The seed whose cell contains the place.
  std::uint32_t owner(const Place& place) const;
  /// Least distance between neighbours in units of h.
  double least_spacing() const;
  double sizing_at(const Place& place) const { return sizing_.at(surface_, place); }
  std::mt19937_64& random() { return random_; }

 private:
  std::uint32_t add(const Hold& hold);
  std::uint32_t add(const Hold& hold, double weight, double h);
  std::uint32_t add_between(const Hold& hold);
  std::uint32_t corner_seed(std::uint32_t vertex, const Place& place);
  void measure_changed();
  void link_curves();
  bool in_curve_ball(std::uint32_t seed, Vec x) const;

  const Surface& surface_;
  const Sizing& sizing_;
  std::vector<Curve> curves_;
  LocalDiagram diagram_;
  std::vector<Hold> hold_;
  std::vector<std::vector<std::uint32_t>> on_curve_;
  std::vector<std::vector<std::uint32_t>> chord_;  // per seed: its neighbours on curves
  std::vector<std::uint32_t> corner_of_vertex_;
  std::vector<FarPoint> far_;
  MaxTree heap_;
  std::mt19937_64 random_;
};

}  // namespace powercell::remeshing
