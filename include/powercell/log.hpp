/// \file
/// What the library does while it works, in lines of text. It is silent unless asked.
#pragma once

#include <functional>
#include <powercell/export.hpp>
#include <string_view>

namespace powercell {

enum class LogLevel {
  info,    ///< devices, compiled kernels, each computation with its times, whatever had to be done again
  detail,  ///< also each chunk, and kernels taken from the cache
};

/// Gets one line, without its end. Called by the thread that computes, by one at a time.
using LogSink = std::function<void(LogLevel level, std::string_view line)>;

/// From now on `sink` gets all lines of the process up to level `most`; an empty sink ends that. While there
/// is none, the environment variable POWERCELL_LOG (`info` or `detail`) sends them to standard error. What
/// the sink throws is passed over, and it must not call this function.
POWERCELL_API void set_log(LogSink sink, LogLevel most = LogLevel::info);

}  // namespace powercell
