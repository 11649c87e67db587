/// \file
/// The columns of a table of seeds.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "apps/io/read_fields.hpp"
#include "apps/io/read_seeds.hpp"

namespace powercell::io {

/// By `choice`, else by the names in `header`, the last record of `records`, else by order.
/// \throw Error invalid_file (missing or repeated coordinates, another dimension than the domain's, a radius)
SeedColumns columns_by_header(const Records& records, const Fields& header, std::size_t dimension,
                              const ColumnChoice& choice);

/// For a table without a header: by the numbers of `choice`, else by order. \throw Error invalid_file
SeedColumns columns_by_order(const Records& records, std::size_t count, std::size_t dimension,
                             const ColumnChoice& choice);

/// Whether a column of this name, in lower case, is taken for the weights.
bool is_weight_name(std::string_view name);

/// "`x y` or `x y weight`"; for messages.
std::string seed_row(std::size_t dimension);

}  // namespace powercell::io
