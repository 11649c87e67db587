/// \file
/// Seeds from a source, sorted in files into pieces along a Hilbert curve.
#pragma once

#include <cstdint>
#include <functional>
#include <powercell/out_of_core.hpp>

#include "lib/diagram/setup.hpp"
#include "lib/out_of_core/files.hpp"

namespace powercell::out_of_core {

/// Of a computation: bytes that passed, and how far it is.
struct Traffic {
  std::uint64_t read = 0, written = 0;
  std::function<void(double)> progress;  ///< a fraction; may throw
};

/// Divides all seeds into pieces by their places along the curve, each small enough to be sorted in memory,
/// checks them on the way and leaves duplicates out. Makes a Store in the folder.
/// \param piece  the most seeds of one
/// \throw Error invalid_seed (the one that a diagram of all would name), write_failed, and what the source
///        throws
void sort_seeds(const SeedSource& source, const DiagramSetup& setup, std::uint64_t piece,
                const LockedFolder& folder, Traffic& traffic);

}  // namespace powercell::out_of_core
