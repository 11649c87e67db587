/// \file
/// Whole files in memory, and errors that name a file and a line.
#pragma once

#include <cstddef>
#include <powercell/error.hpp>
#include <span>
#include <string>
#include <string_view>

namespace powercell::io {

/// The bytes of a regular file.
/// \param words  names that could stand in place of the file, for the message where there is none: the
/// closest of them and of the files beside is proposed
/// \throw Error invalid_file (missing, a directory, unreadable, empty)
std::string read_file(const std::string& path, std::span<const std::string> words = {});

/// ".off" for "a/b/Mesh.OFF"; empty if the name has none.
std::string lower_extension(const std::string& path);

/// Refuses an output file whose extension is not in the list.
/// \param known  e.g. ".svg .png"
/// \throw Error invalid_file
void check_extension(const std::string& path, std::string_view known);

/// \throw Error invalid_file, always: "NAME: WHAT", made readable
[[noreturn]] void fail_file(const std::string& name, const std::string& what);

/// \throw Error invalid_file, always: "NAME:LINE: WHAT", made readable
[[noreturn]] void fail_line(const std::string& name, std::size_t line, const std::string& what);

/// Number of the line, from 1, that holds the byte at `offset`.
std::size_t line_of(std::string_view text, std::size_t offset);

}  // namespace powercell::io
