/// \file
/// Lines of text about the work in progress. The library is silent unless a sink is set.
#pragma once

#include <functional>
#include <powercell/export.hpp>
#include <string_view>

namespace powercell {

enum class LogLevel {
  info,    ///< devices, compiled kernels, each computation with its times, repeated work
  detail,  ///< also each chunk, and kernels taken from the cache
};

/// Receives one line, without a newline. Called from the computing threads, one call at a time.
using LogSink = std::function<void(LogLevel level, std::string_view line)>;

/// Sends all lines of the process up to level `most` to `sink`; an empty sink removes it. Without a sink the
/// environment variable POWERCELL_LOG (`info` or `detail`) sends them to standard error. Exceptions of the
/// sink are ignored; it must not call this function.
POWERCELL_API void set_log(LogSink sink, LogLevel most = LogLevel::info);

}  // namespace powercell
