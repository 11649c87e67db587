/// \file
/// Words and numbers of a text in memory, with line numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

/// The item that a word belongs to, for messages: "vertex 12".
struct Item {
  const char* thing;
  std::size_t index;
};

enum class Parsed { ok, not_a_number, not_finite, too_large };

/// The whole of `word` as a finite double; a leading '+' is allowed.
Parsed parse_number(std::string_view word, double& value);

/// Whether the word is a number with a decimal comma.
bool has_decimal_comma(std::string_view word);

/// Whether the word is a number with a comma before each group of three digits, as thousands have in English;
/// 1,200 is one, and has a decimal comma too.
bool has_thousands_commas(std::string_view word);

/// Why parse_number refused `word`: "'nan' is not finite".
std::string why_not(std::string_view word, Parsed parsed);

/// Reads words separated by blanks and line ends; `comment` runs to the end of the line.
/// Every failure is an Error invalid_file "NAME:LINE: ...".
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string name, char comment = '#');

  bool at_end();            ///< only blanks and comments are left
  std::string_view peek();  ///< the next word, which remains to be read; empty at the end
  std::string_view word(Item item);
  double number(Item item);
  std::uint64_t count(Item item);  ///< an integer of at least 0
  /// An index in [first, first + size), returned from 0.
  std::uint32_t index(Item item, std::size_t size, std::size_t first = 0);

  /// The rest of the current line without its end and comment; moves to the next line.
  std::string_view rest_of_line();
  /// The next line that is not empty, without its end and comment; nullopt at the end.
  std::optional<std::string_view> line();

  /// Refuses a count of items that does not fit in the rest of the text, so that a wrong header is an error
  /// and not an allocation.
  /// \param least  bytes that each item takes at least
  void check_count(std::uint64_t count, std::size_t least, const char* things) const;

  std::size_t line_number() const { return last_line_; }  ///< of the last word or line read, from 1
  std::size_t offset() const { return at_; }              ///< of the next byte
  void seek(std::size_t offset);                          ///< forward only
  std::string_view text() const { return text_; }
  const std::string& name() const { return name_; }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_blanks();
  std::string_view next_in_text() const;

  std::string_view text_;
  std::string name_;
  char comment_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;       // of the byte at at_
  std::size_t last_line_ = 1;  // of the last word returned
};

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The parts between separators, in `text`; one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

/// With the letters A to Z in lower case, independent of the locale.
std::string lower_case(std::string_view text);

/// Removes the next word, separated by blanks, from `text`; false at the end.
bool next_word(std::string_view& text, std::string_view& word);

}  // namespace powercell::io
