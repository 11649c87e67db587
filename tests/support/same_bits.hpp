/// \file
/// Results of a diagram compared bit for bit, NaN included.
#pragma once

#include <powercell/diagram.hpp>
#include <string>
#include <vector>

namespace powercell::test {

/// All that a diagram gives.
struct Results {
  Measures measures;
  Adjacency adjacency;
  Cells cells;
  Dual dual;
};

/// Asks for all of it.
Results results_of(Diagram& diagram);

/// Which arrays differ and where first; empty where every bit is the same.
std::string bit_differences(const Measures& a, const Measures& b);
std::string bit_differences(const Adjacency& a, const Adjacency& b);
std::string bit_differences(const Cells& a, const Cells& b);
std::string bit_differences(const Dual& a, const Dual& b);
std::string bit_differences(const Results& a, const Results& b);

}  // namespace powercell::test
