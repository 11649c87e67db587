/// \file
/// The argument of --only: some of the seeds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/io/tables/read_seeds.hpp"

namespace powercell::app {

/// Reads a file with a seed in the first field of each line: its id where the table of seeds has a column of
/// ids, else its index from 0, as in the column `seed` of tables. A header `seed` or `id`, empty lines and
/// those that begin with # are skipped.
/// \return indices, in the order of the file
/// \throw Error invalid_file, with the line: unreadable, no such seed, a seed that is there twice
std::vector<std::uint32_t> read_only(const std::string& path, const io::SeedTable& seeds);

}  // namespace powercell::app
