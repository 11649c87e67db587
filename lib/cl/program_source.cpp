#include "lib/cl/program_source.hpp"

#include <algorithm>
#include <optional>
#include <powercell/error.hpp>
#include <set>

namespace powercell::cl {
namespace {

void skip_blanks(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
}

/// The path of an `#include "path"` line.
std::optional<std::string_view> included_path(std::string_view line) {
  skip_blanks(line);
  if (!line.starts_with('#')) return std::nullopt;
  line.remove_prefix(1);
  skip_blanks(line);
  constexpr std::string_view keyword = "include";
  if (!line.starts_with(keyword)) return std::nullopt;
  line.remove_prefix(keyword.size());
  skip_blanks(line);
  if (!line.starts_with('"')) return std::nullopt;
  line.remove_prefix(1);
  const auto end = line.find('"');
  if (end == std::string_view::npos) return std::nullopt;
  return line.substr(0, end);
}

class Expansion {
 public:
  explicit Expansion(const SourceFiles& files) : files_(files) {}

  void add(std::string_view path, const std::string& included_from) {
    const auto found =
        std::find_if(files_.begin(), files_.end(), [&](const auto& f) { return f.first == path; });
    if (found == files_.end())
      throw Error(ErrorCode::internal, included_from + "no kernel file \"" + std::string(path) +
                                           "\" is embedded in the library; paths are relative to kernels/");
    if (!seen_.insert(found->first).second) return;
    mark(1, path);
    std::size_t number = 0;
    for (std::string_view rest = found->second; !rest.empty();) {
      const std::size_t end = rest.find('\n');
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      ++number;
      if (const auto inner = included_path(line)) {
        add(*inner, "kernels/" + std::string(path) + ":" + std::to_string(number) + ": ");
        mark(number + 1, path);
      } else {
        text_.append(line).push_back('\n');
      }
    }
  }

  std::string take() { return std::move(text_); }

 private:
  void mark(std::size_t line, std::string_view path) {
    text_ += "#line " + std::to_string(line) + " \"kernels/" + std::string(path) + "\"\n";
  }

  const SourceFiles& files_;
  std::set<std::string_view> seen_;
  std::string text_;
};

}  // namespace

std::string expand_includes(const SourceFiles& files, std::string_view file) {
  Expansion expansion(files);
  expansion.add(file, "");
  return expansion.take();
}

}  // namespace powercell::cl
