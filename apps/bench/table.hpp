/// \file
/// The benchmark as text.
#pragma once

#include <string>

#include "apps/bench/record.hpp"

namespace powercell::app {

std::string table_head();
std::string table_line(const BenchRow& row);

/// Lines about rows whose runs scatter by more than `much_scatter`; empty if none does.
std::string scatter_notes(const BenchRecord& record);

/// The figure that stands for each device: million cells a second in the cube, or why there is none; empty
/// without the cube.
std::string headline(const BenchRecord& record);

}  // namespace powercell::app
