/// \file
/// The work of a benchmark: domains by name and their seeds, the same for every contender.
#pragma once

#include <powercell/domain.hpp>
#include <string>

#include "tests/support/generators.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::bench {

using test::Distribution;
using test::SeedArray;
using test::WeightRange;

struct Work {
  std::string domain;  ///< a name for domain_of
  Distribution distribution = Distribution::white;
  WeightRange weights = WeightRange::W0;
  std::size_t n = 0;

  /// stage/domain/distribution/weights/precision/provider/n
  std::string name(const std::string& stage, const std::string& precision, const std::string& provider) const;
};

/// "box2", "box3": the unit square and cube. "surface": a torus of 5,120 triangles. "tets": the unit cube as
/// 16,464 tetrahedra of uneven shape. "bracket": the machine part of examples/data. "gyroid": a porous body
/// of tetrahedra. "islands": a polygon of three parts with a hole. \throw std::invalid_argument
Domain domain_of(const std::string& name);
bool is_box(const std::string& domain);
int dimension_of(const std::string& domain);  ///< of the space
/// The triangles or tetrahedra of "surface", "tets", "bracket" and "gyroid". \throw std::invalid_argument
test::Mesh mesh_of(const std::string& name);

/// The seeds of a work, a function of the work alone. They lie in the domain, except for "islands", "bracket"
/// and "gyroid" (in its bounding box) and "surface": these are mapped from the unit square to the smooth
/// torus, preserving ratios of areas, and then moved by up to half of their spacing along each axis. (Exactly
/// on a torus, whole circles of seeds would be cospherical, the worst case for a triangulation in space.)
SeedArray seeds_of(const Work& work);

}  // namespace powercell::bench
