/// \file
/// The images of seeds that bound the cells of a periodic domain.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lib/domain/period.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Wrapped seeds, and behind them in rank their images within a margin around the part of the lattice that
/// seeds are wrapped into; of seeds with small cells, only those that such a cell can have as neighbours.
/// Only the cells of the seeds themselves are clipped. `input` of an image is that of its seed.
struct Images {
  SeedSet seeds;
  std::uint32_t own = 0;            ///< seeds; the images have the ranks from here on
  std::vector<std::uint32_t> rank;  ///< per image: of its seed
  std::vector<Shift> shift;         ///< per image: from its seed, in the reduced basis
  std::vector<std::int32_t> code;   ///< per image: a number for its shift, minus that of the opposite one
  double margin = 0;                ///< a distance
  /// Per seed the margin of its own images, where these differ; else empty.
  std::vector<double> seed_margin;

  double margin_of(std::uint32_t seed) const { return seed_margin.empty() ? margin : seed_margin[seed]; }
  std::uint32_t seed_of(std::uint32_t r) const { return r < own ? r : rank[r - own]; }
  Shift shift_of(std::uint32_t r) const { return r < own ? Shift{} : shift[r - own]; }
};

/// The margin to try first: what the largest cells of white noise need.
double first_margin(const Period& period, const SeedSet& seeds);

/// The margin within which there are all images that a cell can have as neighbours, (34a).
double complete_margin(const Period& period);

/// \param seeds  wrapped, in Hilbert order
/// \throw Error unsupported if there would be more than most_seeds_of_diagram
Images make_images(const Period& period, const SeedSet& seeds, double margin, int threads);

/// Appends the images within a wider margin. The others keep their ranks.
/// \param clearance  per seed a distance within which it has all its neighbours, (34b): its own images are
///                   within this margin
/// \throw Error as make_images
void widen(Images& images, const Period& period, double margin, std::span<const double> clearance,
           int threads);

/// The images of seeds with new weights at the same positions.
void set_weights(Images& images, const SeedSet& seeds, int threads);

/// Without the seeds whose cells are empty, and their images.
/// \param hidden  by rank; that of images does not count
Images without_hidden(const Images& images, const std::vector<std::uint8_t>& hidden);

/// Proves that no image outside the margin cuts a cell (docs/mathematics.md (34b)).
class MarginProof {
 public:
  /// \param reach_error  of margin_for(), relative
  MarginProof(const Period& period, const Images& images, double reach_error);
  /// The distance from seed `rank` within which it has all its neighbours.
  /// \param reach  no point of the cell is farther from its seed
  double clearance(std::uint32_t rank, double reach) const;
  /// The margin that the cell of seed `rank` needs for its proof, 0 if it has it.
  double margin_for(std::uint32_t rank, double clearance) const;

 private:
  const Period& period_;
  const Images& images_;
  double most_weight_, factor_;
};

/// From results near wrapped seeds to results near the seeds as given.
struct Placement {
  const Period& period;
  const Images& images;
  const std::vector<Shift>& wrapped;  ///< by input index: from the wrapped seed to the given one

  /// The image in which `neighbor`, by rank, borders the cell of `rank`: moves the neighbour as given, in the
  /// vectors as given.
  Shift shift_of_wall(std::uint32_t rank, std::uint32_t neighbor) const;
  bool is_inside(std::uint32_t rank) const { return wrapped[images.seeds.input[rank]] == Shift{}; }
  /// The seed as given minus the wrapped one.
  std::array<double, 3> offset(std::uint32_t rank) const {
    return period.sum_given(wrapped[images.seeds.input[rank]]);
  }
};

}  // namespace powercell
