/// \file
/// Sorting the walls of one cell. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

namespace powercell {

/// Sorts `count` keys below 2^31 ascending into `sorted_key`, and the values with them; of equal keys the
/// order stays. Returns whether there are equal keys. The results are elsewhere than what they are made of.
bool sort_row(const std::uint32_t* key, const double* value, std::size_t count, std::uint32_t* sorted_key,
              double* sorted_value);

}  // namespace powercell
