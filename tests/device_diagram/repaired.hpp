/// \file
/// The results of a DeviceDiagram before and after repair(), compared with those of an exact Diagram.
#pragma once

#include <powercell/diagram.hpp>
#include <vector>

#include "tests/device_diagram/caller.hpp"
#include "tests/support/generators.hpp"

namespace powercell::test {

using Seeds = std::vector<std::uint32_t>;

Options in_precision(Precision precision);

/// Row `k` of measures of the host has the bits of cell `i` in device memory.
bool same_bits(const Output& found, std::size_t i, const Measures& host, std::size_t k, Precision precision);

struct Repaired {
  Output before, output;
  Adjacency adjacency;
  Seeds list;  ///< of the cells computed
};

/// \param room  for entries of rows
Repaired repaired(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds, std::size_t room);

/// Compares everything to Diagram. \return how many cells were repaired
std::size_t check_repaired(Caller& caller, DeviceDiagram& diagram, const SeedArray& given);

}  // namespace powercell::test
