/// \file
/// The closest match of a mistyped word.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

/// The candidate that was probably meant: the nearest by letters changed, added, left out, or swapped with
/// the next one, of which there may be one in three letters; else the only candidate that begins with the
/// word. Upper and lower case count as equal. Empty if none is near. Of equally near ones the first is taken.
std::string closest(std::string_view word, std::span<const std::string> candidates);

/// The names of the files and folders in the folder of `path`; empty if it cannot be read.
std::vector<std::string> names_beside(const std::string& path);

/// "; did you mean X?", or nothing if `meant` is empty; for the end of messages.
std::string did_you_mean(const std::string& meant);

}  // namespace powercell::io
