/// \file
/// Checks of the numbers that options take, for CLI::Option::check(): what is wrong with it, or nothing.
/// Those of CLI11 tell the limits of doubles with all their 309 digits, and 1e-16 as 0.000000.
#pragma once

#include <functional>
#include <string>

namespace powercell::app {

using NumberCheck = std::function<std::string(const std::string&)>;

NumberCheck above_zero();
NumberCheck not_below_zero();
NumberCheck between(double low, double high);

}  // namespace powercell::app
