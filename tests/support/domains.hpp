/// \file
/// Small named shapes of every kind of domain.
#pragma once

#include <powercell/domain.hpp>
#include <string>
#include <vector>

#include "tests/support/generators.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::test {

struct NamedDomain {
  std::string name;
  Domain domain;
};

using Parts = std::vector<PolygonPart>;
Parts unit_square();
Parts letter_u();           ///< non-convex, with collinear points
Parts square_with_holes();  ///< two holes, outer ring clockwise
Parts islands();            ///< three parts, one of them inside the hole of another
Parts comb(int teeth);      ///< thin teeth: many convex pieces

Domain surface_of(const Mesh& mesh);
Domain volume_of(const Mesh& mesh);
/// The square [0,1]^2 or cube [0,1]^3 as a box domain.
Domain unit_box(int dimension);

std::vector<NamedDomain> polygon_domains();
std::vector<NamedDomain> surface_domains();
std::vector<NamedDomain> volume_domains();
std::vector<NamedDomain> box_domains();
/// Boxes with one to three periodic axes, and lattices with and without a reduced basis, in plane and space.
std::vector<NamedDomain> periodic_domains();
/// Polygon, surface, volume, square and cube.
std::vector<NamedDomain> one_of_each();

/// n points uniform in measure on the regions of the domain (n x d).
/// \pre the regions are polygons, tetrahedra or one box
std::vector<double> points_in(const Domain& domain, std::size_t n, Random& random);
/// Seeds on or near the domain: on a surface points_in() moved off it by up to half the spacing; else
/// scatter() in the bounding box enlarged by a tenth, so that some seeds lie outside. Weights are for the
/// domain's spacing.
SeedArray seeds_for(const Domain& domain, Distribution distribution, WeightRange range, std::size_t n,
                    Random& random);

struct SeededDomain {
  NamedDomain domain;
  SeedArray seeds;
};
/// Each domain with n white seeds of weights W1, which depend on the test seed and the domain only.
std::vector<SeededDomain> with_seeds(const std::vector<NamedDomain>& domains, std::size_t n);

}  // namespace powercell::test
