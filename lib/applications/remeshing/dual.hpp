/// \file
/// The triangle mesh dual to the cells of seeds on a surface, its defects and their repair.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/sampling.hpp"

namespace powercell::remeshing {

/// One triangle for each point where three cells meet. Its corners are seeds, oriented as the surface.
struct DualMesh {
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

/// Reasons why the dual is not a mesh with the topology of the surface (docs/mathematics.md, "Remeshing").
struct Defects {
  /// Per connected part of a cell without its seed: a place in it, opposite to the seed.
  std::vector<Place> fragments;
  std::vector<std::uint32_t> outside;                          ///< seeds outside their own cells
  std::vector<std::uint32_t> not_discs;                        ///< seeds whose cells are not discs
  std::vector<std::pair<std::uint32_t, std::uint32_t>> twice;  ///< pairs of cells that share several walls
  std::vector<std::uint32_t> seeds;  ///< vertices where the dual is not a manifold for another reason
  /// Chords of curves (a curve, and the rank of the seed before the chord) that the cells of other seeds
  /// interrupt, or that are not edges of the dual.
  std::vector<std::pair<std::uint32_t, std::size_t>> chords;

  std::size_t count() const {
    return fragments.size() + outside.size() + not_discs.size() + twice.size() + seeds.size() + chords.size();
  }
};

/// The dual of the cells.
/// \param defects  output
DualMesh dual_of(const Sampling& sampling, Defects& defects, Progress progress = {});

/// Adds seeds at the defects until there are none.
/// \param most  limit on the number of seeds
/// \param left  output: the place of a defect that is left
/// \return nothing if these do not suffice, or added seeds do not make the defects fewer
/// \throw Error interrupted
std::optional<DualMesh> mend(Sampling& sampling, std::size_t most, Place& left, Progress progress = {});

}  // namespace powercell::remeshing
