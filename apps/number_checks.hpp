/// \file
/// Range checks for CLI::Option::check(): they return the fault of a number, empty if it has none. CLI11's
/// own print the limits of doubles with 309 digits, and 1e-16 as 0.000000.
#pragma once

#include <functional>
#include <string>

namespace powercell::app {

using NumberCheck = std::function<std::string(const std::string&)>;

NumberCheck above_zero();
NumberCheck not_below_zero();
NumberCheck between(double low, double high);

}  // namespace powercell::app
