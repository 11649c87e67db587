#include "apps/io/read/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>
#include <system_error>
#include <vector>

#include "apps/io/closest.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

[[noreturn]] void fail_missing(const std::string& path, std::span<const std::string> words) {
  // "shpere:40" stands for "sphere:40": what follows the colon is a number.
  const std::size_t colon = path.find(':');
  std::string meant = closest(path.substr(0, colon == std::string::npos ? colon : colon + 1), words);
  if (meant.empty()) {
    const std::filesystem::path file(path);
    meant = closest(file.filename().string(), names_beside(path));
    if (!meant.empty()) meant = file.parent_path() / meant;
  }
  fail_file(path, "no such file" + (meant.empty() ? "; check the path" : did_you_mean(meant)));
}

/// The words of a list that blanks separate.
std::vector<std::string> words_of(std::string_view list) {
  std::vector<std::string> words;
  std::istringstream stream{std::string(list)};
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

void fail_file(const std::string& name, const std::string& what) {
  throw Error(ErrorCode::invalid_file, fmt::format("{}: {}", name, readable(what)));
}

void fail_line(const std::string& name, std::size_t line, const std::string& what) {
  throw Error(ErrorCode::invalid_file, fmt::format("{}:{}: {}", name, line, readable(what)));
}

std::size_t line_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string lower_extension(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

void check_extension(const std::string& path, std::string_view known) {
  const std::string wanted = lower_extension(path) + " ";
  if (wanted.size() > 1 && (std::string(known) + " ").find(wanted) != std::string::npos) return;
  throw Error(ErrorCode::invalid_file,
              fmt::format("{}: unknown extension of an output file; known are {}{}", path, known,
                          did_you_mean(closest(lower_extension(path), words_of(known)))));
}

std::string read_file(const std::string& path, std::span<const std::string> words) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (status.type() == std::filesystem::file_type::not_found) fail_missing(path, words);
  if (std::filesystem::is_directory(status)) fail_file(path, "is a directory; name a file in it");

  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) fail_file(path, fmt::format("cannot be opened: {}", std::strerror(errno)));

  // Read until the end, not by the size at the start: pipes such as /dev/stdin have no size.
  std::string bytes;
  constexpr std::size_t chunk = std::size_t{1} << 20;
  const auto size = std::filesystem::file_size(path, code);
  if (!code) bytes.reserve(size + chunk + 1);
  for (std::size_t used = 0;;) {
    bytes.resize(used + chunk);
    const std::size_t got = std::fread(bytes.data() + used, 1, chunk, file.get());
    used += got;
    if (got < chunk) {
      bytes.resize(used);
      break;
    }
  }
  if (std::ferror(file.get())) fail_file(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  if (bytes.empty()) fail_file(path, "is empty");
  return bytes;
}

}  // namespace powercell::io
