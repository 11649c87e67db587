/// \file
/// Bitwise comparison of results, including NaN.
#pragma once

#include <powercell/diagram.hpp>
#include <string>
#include <vector>

namespace powercell::test {

/// All results of a diagram.
struct Results {
  Measures measures;
  Adjacency adjacency;
  Cells cells;
  Dual dual;
};

/// Computes all results.
Results results_of(Diagram& diagram);

/// The arrays that differ, each with its first difference; empty if all bits are equal.
std::string bit_differences(const Measures& a, const Measures& b);
std::string bit_differences(const Adjacency& a, const Adjacency& b);
std::string bit_differences(const Cells& a, const Cells& b);
std::string bit_differences(const Dual& a, const Dual& b);
std::string bit_differences(const Results& a, const Results& b);

}  // namespace powercell::test
