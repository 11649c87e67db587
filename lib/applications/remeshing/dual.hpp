/// \file
/// The triangle mesh that is dual to the cells of seeds on a surface, and where it is not one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/sampling.hpp"

namespace powercell::remeshing {

/// A triangle for each point where three cells meet; corners are seeds, as the surface is oriented.
struct DualMesh {
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

/// Where the dual cannot be a mesh like the surface (docs/mathematics.md, "Remeshing").
struct Defects {
  /// A place in each part of a cell that its seed is not in, opposite to the seed.
  std::vector<Place> fragments;
  std::vector<std::uint32_t> outside;                          ///< seeds that are not in their own cells
  std::vector<std::uint32_t> not_discs;                        ///< seeds whose cells go around something
  std::vector<std::pair<std::uint32_t, std::uint32_t>> twice;  ///< seeds whose cells meet more than once
  std::vector<std::uint32_t> seeds;  ///< at which the dual is no manifold for another reason
  /// Places of curves that belong to cells of other seeds, and chords that are no edge: a curve and the
  /// rank of the seed before.
  std::vector<std::pair<std::uint32_t, std::size_t>> chords;

  bool none() const {
    return fragments.empty() && outside.empty() && not_discs.empty() && twice.empty() && seeds.empty() &&
           chords.empty();
  }
};

/// The dual of the cells as they are, and what is wrong with it.
DualMesh dual_of(const Sampling& sampling, Defects& defects, Progress progress = {});

/// Adds seeds where there are defects until there are none.
/// \param most      seeds there may be in the end
/// \throw Error invalid_argument when they do not suffice; interrupted
DualMesh mend(Sampling& sampling, std::size_t most, Progress progress = {});

}  // namespace powercell::remeshing
