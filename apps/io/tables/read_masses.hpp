/// \file
/// The masses of a transport: a column of a table.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/tables/read_seeds.hpp"

namespace powercell::io {

/// One number for each seed, in the order of the rows.
/// \param column  name in the header; empty for "mass" or the only column
/// \throw Error invalid_file (file and line; if there are not `seeds` rows), invalid_argument (a mass that is
///   negative, zero or not finite: file, line and seed)
std::vector<double> read_masses(const std::string& path, const std::string& column, std::size_t seeds);

/// The same from memory.
std::vector<double> parse_masses(std::string_view text, const std::string& column, std::size_t seeds,
                                 const std::string& name);

/// A column of the seeds' own table, which has a header.
/// \param name  of the table, for messages
std::vector<double> masses_of_table(const SeedTable& seeds, const std::string& column,
                                    const std::string& name);

}  // namespace powercell::io
