/// \file
/// Whole files in memory, and the words every reader uses for a malformed one.
#pragma once

#include <cstddef>
#include <powercell/error.hpp>
#include <string>
#include <string_view>

namespace powercell::io {

/// The bytes of a regular file. \throw Error invalid_file (missing, a directory, unreadable, empty)
std::string read_file(const std::string& path);

/// ".off" for "a/b/Mesh.OFF"; empty where the name has none.
std::string lower_extension(const std::string& path);

/// Without control characters, so that it stays on one line and leaves the terminal alone.
std::string one_line(std::string text);

/// `what` for a message, which may quote a file or its parser: on one line, and cut
/// off where it would fill the terminal.
std::string readable(std::string what);

/// \throw Error invalid_file, always: "NAME: what".
[[noreturn]] void fail_file(const std::string& name, const std::string& what);

/// \throw Error invalid_file, always: "NAME:LINE: what".
[[noreturn]] void fail_line(const std::string& name, std::size_t line, const std::string& what);

/// Number of the line, from 1, that holds the byte at `offset`.
std::size_t line_of(std::string_view text, std::size_t offset);

}  // namespace powercell::io
