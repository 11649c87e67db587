/// \file
/// Seeds that miss the domain: latitudes taken for longitudes, numbers of rows taken for coordinates, metres
/// beside degrees.
#pragma once

#include <array>
#include <cstddef>
#include <powercell/domain.hpp>
#include <span>
#include <string>
#include <vector>

namespace powercell::io {

/// A box in which seeds are expected.
struct SeedBox {
  std::size_t dimension = 2;
  std::array<double, 3> low{}, high{};
  double margin = 0;
  bool contains(const double* point) const;
};

/// The box of a domain; of a surface, whose seeds may lie off it, with a margin of half its diagonal.
/// Infinite along periodic axes.
SeedBox seed_box(const Domain& domain);
/// The box of polygons.
SeedBox seed_box(const std::vector<PolygonPart>& parts);

/// \param positions  n x dimension, in the coordinates of the box
std::size_t count_outside(const SeedBox& box, std::span<const double> positions);

/// Whether fewer than one seed in twenty lies in the box; stops at the first that settles it.
bool most_outside(const SeedBox& box, std::span<const double> positions);

/// "12 of 3,000 seeds lie outside the domain's box (x from 0 to 1, y from 0 to 1)", the brackets if
/// `with_box`.
std::string outside_line(const SeedBox& box, std::span<const double> positions, bool with_box);

/// A column of numbers that could be coordinates, of a sample of the seeds.
struct Column {
  std::size_t index;
  std::vector<double> values;
};
/// Every how many seeds the sample takes one, of n.
std::size_t sample_step(std::size_t n);
/// The coordinates of the sample, with the indices 0, 1 and 2.
std::vector<Column> coordinate_columns(std::span<const double> positions, std::size_t dimension);

/// What would bring seeds into a box.
struct WayIn {
  enum class Kind { none, columns, seeds_in_lengths, seeds_in_degrees, unit };
  Kind kind = Kind::none;
  std::vector<std::size_t> columns;  ///< indices of those to take for x, y (and z)
  double share = 0;                  ///< of the sample, inside with these columns
  double factor = 1;                 ///< times the coordinates: seeds and domain have different units
};

/// \param columns  some to choose the coordinates from; none to leave columns as they are
WayIn way_in(const SeedBox& box, std::span<const double> positions, std::vector<Column> columns);

}  // namespace powercell::io
