/// \file
/// Lattices, rotated, scaled and moved, for tests and campaigns of ties.
#pragma once

#include <array>
#include <cmath>
#include <powercell/domain.hpp>
#include <string>
#include <vector>

#include "tests/support/generators.hpp"

namespace powercell::test {

/// The placement of a lattice: x -> scale * (rotation(x - 1/2) + 1/2) + offset.
struct Place {
  std::string name;
  double angle = 0, scale = 1, offset = 0;
};
inline const std::vector<Place> places = {{"plain"},          {"tilted", 0.7},
                                          {"tiny", 0, 1e-6},  {"small", 0, 0x1p-20},
                                          {"huge", 0.3, 1e9}, {"far", 0, 1, 1048576}};

struct Lattice {
  std::string name;
  int dimension;
  std::size_t k;                             ///< periods along an axis
  std::vector<std::array<double, 3>> basis;  ///< within a period of size 1
  std::size_t neighbors;                     ///< of a cell inside
};
inline std::vector<Lattice> lattices() {
  return {{"square", 2, 8, {{0, 0, 0}}, 4},
          {"cubic", 3, 5, {{0, 0, 0}}, 6},
          {"body-centred", 3, 4, {{0, 0, 0}, {0.5, 0.5, 0.5}}, 14},
          {"face-centred", 3, 4, {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}, 12}};
}

struct LatticeSeeds {
  SeedArray array;
  std::vector<bool> inside;  ///< the cell does not meet the boundary of the lattice
};

inline LatticeSeeds lattice_seeds(const Lattice& lattice, const Place& place) {
  LatticeSeeds seeds;
  seeds.array.dimension = lattice.dimension;
  const double h = 1.0 / static_cast<double>(lattice.k);
  const std::size_t layers = lattice.dimension == 3 ? lattice.k : 1;
  for (std::size_t z = 0; z < layers; ++z)
    for (std::size_t y = 0; y < lattice.k; ++y)
      for (std::size_t x = 0; x < lattice.k; ++x)
        for (const auto& b : lattice.basis) {
          double p[3] = {(static_cast<double>(x) + b[0] + 0.25) * h,
                         (static_cast<double>(y) + b[1] + 0.25) * h,
                         (static_cast<double>(z) + b[2] + 0.25) * h};
          bool inside = true;
          for (int k = 0; k < lattice.dimension; ++k) inside = inside && p[k] > 1.2 * h && p[k] < 1 - 1.2 * h;
          const double c = std::cos(place.angle), s = std::sin(place.angle), u = p[0] - 0.5, v = p[1] - 0.5;
          p[0] = c * u - s * v + 0.5;
          p[1] = s * u + c * v + 0.5;
          for (int k = 0; k < lattice.dimension; ++k)
            seeds.array.positions.push_back(place.scale * p[k] + place.offset);
          seeds.array.weights.push_back(0);
          seeds.inside.push_back(inside);
        }
  return seeds;
}

/// A box that contains the lattice and the corners of its dual.
inline Domain box_around(const Place& place, int dimension) {
  const std::vector<double> low(static_cast<std::size_t>(dimension), place.offset - 2 * place.scale),
      high(static_cast<std::size_t>(dimension), place.offset + 3 * place.scale);
  return Domain::box(low, high);
}

}  // namespace powercell::test
