/// \file
/// Numbers and callers' text in messages, the same in every locale. Internal.
#pragma once

#include <cstddef>
#include <string>

namespace powercell {

/// The shortest decimal number that reads back as `value`: for input values, and for two that are compared.
std::string digits(double value);

/// `value` to at most so many significant digits, as %g of printf: for measured values.
std::string digits(double value, int significant);

/// `text` without control characters, so that a message stays on one line and leaves the terminal alone, and
/// cut off after `most` bytes.
std::string readable(std::string text, std::size_t most);

}  // namespace powercell
