/// \file
/// The columns of a table of seeds.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "apps/io/tables/read_seeds.hpp"
#include "apps/io/tables/row_source.hpp"

namespace powercell::io {

/// By `choice`, else by the names in `header`, the last row of `rows`, else by order; the
/// coordinates are the first columns if they come from geometries.
/// \throw Error invalid_file (missing or repeated coordinates, another dimension than the domain's, a radius)
SeedColumns columns_by_header(const RowSource& rows, const Fields& header, std::size_t dimension,
                              const ColumnChoice& choice);

/// For a table without a header: by the numbers of `choice`, else by order.
/// \throw Error invalid_file
SeedColumns columns_by_order(const RowSource& rows, std::size_t count, std::size_t dimension,
                             const ColumnChoice& choice);

/// Whether the header names coordinates of seeds, so that no column of geometries is looked for.
bool names_coordinates(const Fields& header, std::size_t dimension);

/// Whether a column of this name, in lower case, is taken for the weights.
bool is_weight_name(std::string_view name);

/// "`x y` or `x y weight`"; for messages.
std::string seed_row(std::size_t dimension);

}  // namespace powercell::io
