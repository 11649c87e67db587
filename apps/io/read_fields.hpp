/// \file
/// The fields of a line of a table.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "apps/io/read_text.hpp"

namespace powercell::io {

constexpr std::size_t most_columns = 64;
using Fields = std::array<std::string_view, most_columns>;

/// Splits the line that `scanner` is at: a comma or a semicolon ends a field; blanks do where neither stands
/// between two fields. Quotes around a field are taken off. \return how many  \throw Error invalid_file
std::size_t split_fields(const TextScanner& scanner, std::string_view line, Fields& fields);

/// In lower case, without blanks at its ends.
std::string column_name(std::string_view field);

}  // namespace powercell::io
