/// \file
/// Numbers in messages, the same in every locale. Internal.
#pragma once

#include <string>

namespace powercell {

/// The shortest decimal number that reads back as `value`: for what is given, and for two that are compared.
std::string digits(double value);

/// `value` to at most so many significant digits, as %g of printf: for what was measured.
std::string digits(double value, int significant);

}  // namespace powercell
