#include "apps/io/read/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "apps/io/read/file.hpp"

namespace powercell::io {
namespace {

bool blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

std::string without(std::string_view word, std::string_view mark) {
  std::string rest(word);
  for (std::size_t at = 0; (at = rest.find(mark, at)) != std::string::npos;) rest.erase(at, mark.size());
  return rest;
}

// What to do about a word that is a number for people; empty if there is no advice.
std::string number_advice(std::string_view word) {
  double value = 0;
  if (has_thousands_commas(word)) {
    const std::string whole = without(word, ",");
    if (!has_decimal_comma(word))
      return fmt::format(": commas between thousands are not read, write {}", whole);
    std::string decimal(word);
    decimal[decimal.find(',')] = '.';
    return fmt::format(": a comma is not read, write {} if it separates thousands, {} if decimals", whole,
                       decimal);
  }
  if (has_decimal_comma(word)) return ": decimal commas are not read, write a point";
  for (const std::string_view mark : {" ", "\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89", "'", "_"}) {
    const std::string joined = without(word, mark);
    if (joined.size() != word.size() && parse_number(joined, value) == Parsed::ok)
      return fmt::format(": marks between digits are not read, write {}", joined);
  }
  return {};
}

std::string shown(std::string_view word) {  // arbitrary bytes must not disturb the message or the terminal
  std::string safe;
  for (char c : word.substr(0, 40)) safe += (c >= ' ' && c <= '~') ? c : '?';
  return safe + (word.size() > 40 ? "..." : "");
}

}  // namespace

Parsed parse_number(std::string_view word, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || code == std::errc::invalid_argument) return Parsed::not_a_number;
  if (code == std::errc::result_out_of_range) {
    // from_chars does not distinguish numbers too large from numbers too near zero; strtod does.
    value = std::strtod(std::string(word).c_str(), nullptr);
    return std::isfinite(value) ? Parsed::ok : Parsed::too_large;
  }
  return std::isfinite(value) ? Parsed::ok : Parsed::not_finite;
}

bool has_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) return false;
  std::string with_point(word);
  with_point[comma] = '.';
  double value = 0;
  return parse_number(with_point, value) == Parsed::ok;
}

bool has_thousands_commas(std::string_view word) {
  if (!word.empty() && (word[0] == '+' || word[0] == '-')) word.remove_prefix(1);
  const std::vector<std::string_view> groups = split(word.substr(0, word.find('.')), ',');
  if (groups.size() < 2 || groups[0].empty() || groups[0].size() > 3 || groups[0][0] == '0') return false;
  double value = 0;
  return std::all_of(groups.begin() + 1, groups.end(), [](std::string_view g) { return g.size() == 3; }) &&
         parse_number(without(word, ","), value) == Parsed::ok;
}

std::string why_not(std::string_view word, Parsed parsed) {
  switch (parsed) {
    case Parsed::not_finite:
      return fmt::format("'{}' is not a finite number", shown(word));
    case Parsed::too_large:
      return fmt::format("'{}' is too large for a double", shown(word));
    default:
      return fmt::format("'{}' is not a number{}", shown(word), number_advice(word));
  }
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (blank(text.front()) || text.front() == '\n')) text.remove_prefix(1);
  while (!text.empty() && (blank(text.back()) || text.back() == '\n')) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end != std::string_view::npos) text.remove_prefix(end + 1);
  }
  return parts;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

bool next_word(std::string_view& text, std::string_view& word) {
  std::size_t begin = 0;
  while (begin < text.size() && (blank(text[begin]) || text[begin] == '\n')) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !blank(text[end]) && text[end] != '\n') ++end;
  word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return !word.empty();
}

TextScanner::TextScanner(std::string_view text, std::string name, char comment)
    : text_(text), name_(std::move(name)), comment_(comment) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte order mark of UTF-8
}

void TextScanner::fail(const std::string& what) const {
  fail_line(name_, last_line_, what);
}

void TextScanner::skip_blanks() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == '\n') {
      ++line_;
      ++at_;
    } else if (blank(c)) {
      ++at_;
    } else if (c == comment_ && comment_ != '\0') {
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    } else {
      return;
    }
  }
}

bool TextScanner::at_end() {
  skip_blanks();
  return at_ == text_.size();
}

std::string_view TextScanner::next_in_text() const {
  std::size_t end = at_;
  while (end < text_.size() && !blank(text_[end]) && text_[end] != '\n') ++end;
  return text_.substr(at_, end - at_);
}

std::string_view TextScanner::peek() {
  const std::size_t at = at_, line = line_;
  skip_blanks();
  const std::string_view next = next_in_text();
  at_ = at;  // for rest_of_line(), a line end before the word still ends the current line
  line_ = line;
  return next;
}

std::string_view TextScanner::word(Item item) {
  skip_blanks();
  const std::string_view next = next_in_text();
  last_line_ = line_;
  if (next.empty()) fail(fmt::format("the file ends before {} {}; it is truncated", item.thing, item.index));
  at_ += next.size();
  return next;
}

double TextScanner::number(Item item) {
  const std::string_view next = word(item);
  double value = 0;
  const Parsed parsed = parse_number(next, value);
  if (parsed != Parsed::ok) {
    fail(fmt::format("{} {}: {}", item.thing, item.index, why_not(next, parsed)));
  }
  return value;
}

std::uint64_t TextScanner::count(Item item) {
  const std::string_view next = word(item);
  std::uint64_t value = 0;
  const auto [end, code] = std::from_chars(next.data(), next.data() + next.size(), value);
  if (code != std::errc() || end != next.data() + next.size()) {
    fail(fmt::format("{} {}: '{}' is not a whole number of at least 0", item.thing, item.index, shown(next)));
  }
  return value;
}

std::uint32_t TextScanner::index(Item item, std::size_t size, std::size_t first) {
  const std::string_view next = word(item);
  std::int64_t value = 0;
  const auto [end, code] = std::from_chars(next.data(), next.data() + next.size(), value);
  if (code == std::errc::invalid_argument || end != next.data() + next.size()) {
    fail(fmt::format("{} {}: '{}' is not an index", item.thing, item.index, shown(next)));
  }
  const auto low = static_cast<std::int64_t>(first);
  if (code != std::errc() || value < low || static_cast<std::uint64_t>(value - low) >= size) {
    fail(fmt::format("{} {}: index {} is out of range; the file has {} vertices, numbered from {}",
                     item.thing, item.index, shown(next), size, first));
  }
  return static_cast<std::uint32_t>(value - low);
}

std::string_view TextScanner::rest_of_line() {
  last_line_ = line_;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view line = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  if (end < text_.size()) ++line_;
  if (comment_ != '\0') line = line.substr(0, line.find(comment_));
  return trimmed(line);
}

std::optional<std::string_view> TextScanner::line() {
  if (at_end()) return std::nullopt;
  return rest_of_line();
}

void TextScanner::check_count(std::uint64_t count, std::size_t least, const char* things) const {
  const std::size_t left = text_.size() - at_;
  if (count > (left + 1) / least) {
    fail(fmt::format(
        "{} {} are announced, but only {} bytes are left; the file is truncated or the count is wrong", count,
        things, left));
  }
}

void TextScanner::seek(std::size_t offset) {
  for (; at_ < offset && at_ < text_.size(); ++at_) line_ += text_[at_] == '\n';
  last_line_ = line_;
}

}  // namespace powercell::io
