/// \file
/// The figures of a benchmark as a picture.
#pragma once

#include <string>

#include "apps/bench/record.hpp"

namespace powercell::app {

/// Draws an SVG: for each row a line with a dot for each device, from the best run back to the lower
/// quartile, on a logarithmic scale; and the rates of transfers by their size.
/// \throw Error write_failed
void write_plot(const std::string& path, const BenchRecord& record);
/// The same as text.
std::string plot_svg(const BenchRecord& record);

}  // namespace powercell::app
