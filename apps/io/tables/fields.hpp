/// \file
/// The fields of a table, record by record, with the quoting of RFC 4180.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

#include "apps/io/read/text.hpp"
#include "apps/io/tables/row_source.hpp"

namespace powercell::io {

/// The separator of the columns of a table of numbers, from the first line with more than one word: `;` if
/// the line has one, else tab, else `,`, else blanks.
char number_separator(std::string_view text, char comment);

/// " (columns are separated by tabs in this file)"; for messages. Empty for '\0'.
std::string separated_by(char separator);

/// Reads one record after the other. A field in quotes may contain separators, doubled quotes, comments and
/// line ends. Blanks around a field do not belong to it. Several blanks in a row are one separator.
class Records : public RowSource {
 public:
  /// \param comment  character that begins a comment to the end of the line; 0 for no comments
  Records(std::string_view text, std::string name, char separator, char comment = '\0');

  bool next(Fields& fields) override;
  /// From now on only a line that begins with the comment character is a comment, unless blanks separate
  /// the columns: text such as "No # 5" is a field.
  void begin_rows() override;
  const std::string& name() const override { return name_; }
  std::size_t line() const { return line_; }  ///< in which the last record begins, from 1
  std::string place() const override;         ///< the file and that line
  char separator() const override { return separator_; }

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

/// Reads the numbers of a table. A decimal mark is a point, or else a comma if semicolons or tabs separate
/// the columns and the first number with a mark has one.
class FieldNumbers {
 public:
  explicit FieldNumbers(char separator) : separator_(separator) {}

  Parsed read(std::string_view field, double& value);
  /// Why `read` refused the field.
  std::string why_not(std::string_view field, Parsed parsed) const;
  char mark() const { return mark_ == ',' ? ',' : '.'; }

 private:
  bool may_have_commas() const { return separator_ == ';' || separator_ == '\t'; }
  char separator_, mark_ = '\0';  // '\0' until a number has one
};

/// The whole field as a finite double.
/// \param mark  ',' or '.', the only one allowed
Parsed parse_number(std::string_view field, char mark, double& value);

/// In lower case, without blanks at both ends.
std::string column_name(std::string_view field);

}  // namespace powercell::io
