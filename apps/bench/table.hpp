/// \file
/// The benchmark as text.
#pragma once

#include <string>

#include "apps/bench/record.hpp"

namespace powercell::app {

/// "±3 %".
std::string scatter_text(double scatter);

/// Rates, latencies and transfers of a device.
std::string device_lines(const BenchDevice& device);

std::string table_head();
std::string table_line(const BenchRow& row);
std::string table_line(const LeftOut& row);

/// How many rows scatter by more than `much_scatter`, and whether other programs ran; empty if neither.
std::string scatter_notes(const BenchRecord& record);

/// The figure that stands for each device: million cells a second in the cube; empty without the cube.
std::string headline(const BenchRecord& record);

}  // namespace powercell::app
