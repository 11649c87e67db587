/// \file
/// The fields of a table, record by record, with the quoting of RFC 4180.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

using Fields = std::vector<std::string_view>;

/// The separator of the columns of a table of numbers, from the first line with more than one word: `;` if
/// the line has one, else tab, else `,`, else blanks.
char number_separator(std::string_view text, char comment);

/// " (columns are separated by tabs in this file)"; for messages.
std::string separated_by(char separator);

/// Reads one record after the other. A field in quotes may contain separators, doubled quotes, comments and
/// line ends. Blanks around a field do not belong to it. Several blanks in a row are one separator.
class Records {
 public:
  /// \param comment  character that begins a comment to the end of the line; 0 for no comments
  Records(std::string_view text, std::string name, char separator, char comment = '\0');

  /// From now on only a line that begins with the comment character is one: text such as "No # 5" is a field.
  void comment_whole_lines();

  /// The next record with a field that is not empty; false at the end. Fields are valid until the next call.
  bool next(Fields& fields);

  std::size_t line() const { return line_; }  ///< in which the last record begins, from 1
  char separator() const { return separator_; }
  const std::string& name() const { return name_; }
  /// \throw Error invalid_file, always, with the line
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool record(Fields& fields);
  bool at_end_of_record() const;
  void skip_blanks();
  void end_line();
  std::string_view plain();
  std::string_view quoted();

  std::string_view text_;
  std::string name_;
  char separator_, comment_;
  bool whole_lines_ = false;            // whether comments are lines
  std::array<bool, 256> ends_plain_{};  // whether a byte ends a field without quotes
  std::deque<std::string> unescaped_;   // fields of the record that had doubled quotes
  std::size_t at_ = 0, line_ = 1, line_at_ = 1;
};

/// Whether no field is a number, with a decimal point or a decimal comma.
bool is_header(const Fields& fields);

/// In lower case, without blanks at both ends.
std::string column_name(std::string_view field);

}  // namespace powercell::io
