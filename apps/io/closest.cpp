#include "apps/io/closest.hpp"

#include <algorithm>
#include <filesystem>

#include "apps/io/printable.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

/// Changes, additions, omissions and swaps of neighbours that turn one into the other, each letter used once.
std::size_t typing_errors(const std::string& a, const std::string& b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> errors((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return errors[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = i + j;
        continue;
      }
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return errors.back();
}

}  // namespace

std::string closest(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t longest = 200;  // beyond it is no word
  const std::string wanted = lower_case(word);
  if (wanted.empty() || wanted.size() > longest) return {};
  const std::string* best = nullptr;
  std::size_t least = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  least = std::min(least, wanted.size());  // at least one letter is right
  for (const std::string& candidate : candidates) {
    if (candidate.size() > wanted.size() + least || wanted.size() > candidate.size() + least) continue;
    const std::size_t errors = typing_errors(wanted, lower_case(candidate));
    if (errors >= least) continue;
    least = errors;
    best = &candidate;
  }
  if (best != nullptr) return *best;
  if (wanted.size() < 2) return {};
  std::size_t beginning = 0;
  for (const std::string& candidate : candidates)
    if (lower_case(candidate).starts_with(wanted)) {
      ++beginning;
      best = &candidate;
    }
  return beginning == 1 ? *best : std::string();
}

std::vector<std::string> names_beside(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr std::size_t most = 10000;  // so that a message does not take long
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::vector<std::string> names;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end && names.size() < most;
       entry.increment(problem))
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());  // the order of a folder is no order
  return names;
}

std::string did_you_mean(const std::string& meant) {
  return meant.empty() ? std::string() : "; did you mean " + readable(meant) + "?";
}

}  // namespace powercell::io
