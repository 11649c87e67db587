/// \file
/// The columns of a table of seeds.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "apps/io/read_fields.hpp"

namespace powercell::io {

struct SeedColumns {
  std::size_t count = 0;  ///< columns of a row
  std::array<std::size_t, 3> position{0, 1, 2};
  std::optional<std::size_t> weight;
  std::string note;  ///< for a report: the columns used, if the header leaves a doubt
};

/// By the names in `header`, the last record of `records`; by order if it has no known name.
/// \throw Error invalid_file (missing or repeated coordinates, another dimension than the domain's, a radius)
SeedColumns columns_by_header(const Records& records, const Fields& header, std::size_t dimension);

/// For a table without a header. \throw Error invalid_file
SeedColumns columns_by_order(const Records& records, std::size_t count, std::size_t dimension);

/// "`x y` or `x y weight`"; for messages.
std::string seed_row(std::size_t dimension);

}  // namespace powercell::io
