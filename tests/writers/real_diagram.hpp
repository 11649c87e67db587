/// \file
/// Diagrams that the library computes, for tests of writers that need its exact decisions.
#pragma once

#include <memory>
#include <powercell/diagram.hpp>
#include <string>
#include <vector>

#include "apps/io/write/output.hpp"

namespace powercell::test {

struct RealDiagram {
  std::string name;
  std::shared_ptr<Diagram> diagram;
  std::vector<double> positions, weights;
  Cells none = {};

  io::DiagramOutput output();
};

/// \param seeds  n x d   \param weights  n, or none
RealDiagram real_diagram(const std::string& name, const Domain& domain, std::vector<double> seeds,
                         std::vector<double> weights = {}, const Options& options = {});

/// n seeds in the box of the domain, with weights that hide some.
RealDiagram random_diagram(const std::string& name, const Domain& domain, std::size_t n,
                           const Options& options = {});

/// The points of a cubic (square) lattice of n per axis, in the middle of equal parts of the unit box.
std::vector<double> lattice_points(std::size_t per_axis, std::size_t dimension);

/// A plate of 3 x 3 x 1 cubes without the middle one, each in six tetrahedra: walls across it have a hole.
Domain plate_with_hole();

/// Polygons: a square with a square hole; a U.
Domain square_with_hole();

/// Diagrams in boxes, meshes and solids, of seeds in general position and of lattices.
std::vector<RealDiagram> volume_cases();
/// Diagrams in boxes, polygons and surfaces.
std::vector<RealDiagram> flat_cases();

}  // namespace powercell::test
