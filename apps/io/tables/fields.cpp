#include "apps/io/tables/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "apps/io/read/file.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

constexpr std::size_t most_columns = 16384;  // as in spreadsheets

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// The line at `at` without comment, quoted text and blanks at both ends; moves `at` to the next line.
std::string bare_line(std::string_view text, std::size_t& at, char comment) {
  std::string bare;
  bool in_quotes = false;
  for (; at < text.size() && (in_quotes || text[at] != '\n'); ++at) {
    const char c = text[at];
    if (c == comment && !in_quotes) {
      at = std::min(text.find('\n', at), text.size());
      break;
    }
    const bool in_word = !bare.empty() && !is_blank(bare.back()) && bare.back() != ',' && bare.back() != ';';
    if (c == '"' && (in_quotes || !in_word))
      in_quotes = !in_quotes;
    else if (!in_quotes)
      bare += c;
  }
  ++at;
  return std::string(trimmed(bare));
}

}  // namespace

char number_separator(std::string_view text, char comment) {
  // A line of one word, such as a count or the name of the only column, shows no separator; the next line
  // may.
  for (std::size_t at = 0, lines = 0; at < text.size() && lines < 2;) {
    const std::string line = bare_line(text, at, comment);
    for (const char c : {';', '\t', ',', ' '})
      if (line.find(c) != std::string::npos) return c;
    lines += !line.empty();
  }
  return ' ';
}

std::string separated_by(char separator) {
  if (separator == '\0') return {};
  const char* name = separator == ';'    ? "semicolons"
                     : separator == '\t' ? "tabs"
                     : separator == ','  ? "commas"
                                         : "blanks";
  return fmt::format(" (columns are separated by {} in this file)", name);
}

Records::Records(std::string_view text, std::string name, char separator, char comment)
    : text_(text), name_(std::move(name)), separator_(separator), comment_(comment) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // the byte order mark of spreadsheets
  for (std::size_t c = 0; c < ends_plain_.size(); ++c)
    ends_plain_[c] = separator == ' ' && is_blank(static_cast<char>(c));
  for (const char c : {'\n', separator}) ends_plain_[static_cast<unsigned char>(c)] = true;
  if (comment != '\0') ends_plain_[static_cast<unsigned char>(comment)] = true;
}

void RowSource::fail(const std::string& what) const {
  fail_file(place(), what);
}

std::string Records::place() const {
  return fmt::format("{}:{}", name_, line_);
}

void Records::begin_rows() {
  if (separator_ == ' ') return;
  whole_lines_ = true;
  if (comment_ != '\0') ends_plain_[static_cast<unsigned char>(comment_)] = false;
}

bool Records::next(Fields& fields) {
  while (at_ < text_.size()) {
    fields.clear();
    unescaped_.clear();
    line_ = line_at_;
    if (record(fields)) return true;
  }
  return false;
}

/// Reads a record; whether it has a field that is not empty.
bool Records::record(Fields& fields) {
  bool filled = false;
  while (true) {
    skip_blanks();
    if (separator_ == ' ' && at_end_of_record()) break;
    if (fields.empty() && comment_ != '\0' && at_ < text_.size() && text_[at_] == comment_) break;
    if (fields.size() == most_columns) fail(fmt::format("more than {} columns", most_columns));
    fields.push_back(at_ < text_.size() && text_[at_] == '"' ? quoted() : plain());
    filled = filled || !fields.back().empty();
    if (separator_ == ' ') continue;
    if (at_end_of_record()) break;
    ++at_;
  }
  end_line();
  return filled;
}

bool Records::at_end_of_record() const {
  return at_ == text_.size() || text_[at_] == '\n' ||
         (text_[at_] == comment_ && comment_ != '\0' && !whole_lines_);
}

void Records::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_]) && (separator_ == ' ' || text_[at_] != separator_)) ++at_;
}

void Records::end_line() {
  at_ = std::min(text_.find('\n', at_), text_.size());
  if (at_ == text_.size()) return;
  ++at_;
  ++line_at_;
}

std::string_view Records::plain() {
  std::size_t end = at_;
  while (end < text_.size() && !ends_plain_[static_cast<unsigned char>(text_[end])]) ++end;
  const std::string_view field = text_.substr(at_, end - at_);
  at_ = end;
  return trimmed(field);
}

std::string_view Records::quoted() {
  std::size_t begin = ++at_;
  std::string* whole = nullptr;  // the field with doubled quotes made single, if it has any
  std::string_view field;
  while (true) {
    const std::size_t end = text_.find('"', at_);
    if (end == std::string_view::npos) fail("a quote is opened and never closed");
    for (; at_ < end; ++at_) line_at_ += text_[at_] == '\n';
    ++at_;
    const bool doubled = at_ < text_.size() && text_[at_] == '"';
    field = text_.substr(begin, end - begin);
    if (doubled && !whole) whole = &unescaped_.emplace_back();
    if (whole) field = whole->append(field).append(doubled ? "\"" : "");
    if (!doubled) break;
    begin = ++at_;
  }
  if (separator_ == ' ' && at_ < text_.size() && is_blank(text_[at_])) return field;
  skip_blanks();
  if (!at_end_of_record() && text_[at_] != separator_)
    fail("there is text after a closing quote; double the quotes inside a quoted field");
  return field;
}

bool is_header(const Fields& fields) {
  double value = 0;
  return std::none_of(fields.begin(), fields.end(), [&](std::string_view field) {
    return parse_number(field, value) != Parsed::not_a_number || has_decimal_comma(field);
  });
}

Parsed parse_number(std::string_view field, char mark, double& value) {
  if (mark != ',') return parse_number(field, value);
  if (field.find('.') != std::string_view::npos) return Parsed::not_a_number;
  std::string with_point(field);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  return parse_number(with_point, value);
}

Parsed FieldNumbers::read(std::string_view field, double& value) {
  if (mark_ == '\0') {
    if (may_have_commas() && has_decimal_comma(field))
      mark_ = ',';
    else if (field.find('.') != std::string_view::npos)
      mark_ = '.';
  }
  return parse_number(field, mark_, value);
}

std::string FieldNumbers::why_not(std::string_view field, Parsed parsed) const {
  double value = 0;
  if (mark_ == ',' && parse_number(field, value) == Parsed::ok)
    return fmt::format("'{}' has a decimal point, but numbers before have decimal commas", field);
  if (mark_ == '.' && may_have_commas() && has_decimal_comma(field))
    return fmt::format("'{}' has a decimal comma, but numbers before have decimal points", field);
  std::string reason = io::why_not(field, parsed);
  if (has_decimal_comma(field) && !has_thousands_commas(field))
    reason += ", or separate the columns by semicolons";
  return reason;
}

std::string column_name(std::string_view field) {
  std::string name(trimmed(field));
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

}  // namespace powercell::io
