/// \file
/// Seeds that miss the domain: latitudes taken for longitudes, numbers of rows taken for coordinates, metres
/// beside degrees.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <powercell/domain.hpp>
#include <string>
#include <vector>

#include "apps/io/read_seeds.hpp"

namespace powercell::app {

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

std::size_t count_outside(const SeedBox& box, const std::vector<double>& positions);

/// Seeds that miss the box.
struct Miss {
  bool refused = false;  ///< there are so many that it is hardly meant
  std::string message;   ///< how many, the columns they were taken from, and which to try instead
};

/// Whether fewer than one seed in twenty lies in the box. \param positions  in the coordinates of the box
/// \param table  the seeds as they were read, in other coordinates if `transformed`
std::optional<Miss> find_miss(const SeedBox& box, const std::vector<double>& positions,
                              const io::SeedTable& table, bool transformed);

/// "12 of 3,000 seeds lie outside the domain's box".
std::string outside_line(std::size_t outside, std::size_t seeds);

}  // namespace powercell::app
