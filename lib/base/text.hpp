/// \file
/// Numbers and callers' text for messages, the same in every locale.
#pragma once

#include <cstddef>
#include <string>

namespace powercell {

/// The shortest decimal number that reads back as `value`: for input values and for values that are compared.
std::string digits(double value);

/// `value` with at most `significant` digits, like printf's %g: for measured values.
std::string digits(double value, int significant);

/// "(x, y, z)", for places in messages.
/// \param point  3 coordinates
std::string place_text(const double* point);

/// `text` cut off after `most` bytes, with control characters replaced, so that a message stays on one line
/// and cannot control the terminal.
std::string readable(std::string text, std::size_t most);

}  // namespace powercell
