/// \file
/// Writing to the log (powercell/log.hpp).
#pragma once

#include <concepts>
#include <powercell/log.hpp>
#include <string>

namespace powercell {

bool is_logged(LogLevel level) noexcept;
void write_line(LogLevel level, const std::string& line) noexcept;

/// Writes the line that `make` returns; calls `make` only if lines of this level are logged.
void write_log(LogLevel level, const std::invocable auto& make) {
  if (is_logged(level)) write_line(level, make());
}

/// "1.234 s", for lines of the log.
std::string in_seconds(double seconds);

}  // namespace powercell
