#include "lib/out_of_core/call_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <powercell/error.hpp>
#include <string>

namespace powercell::out_of_core {
namespace {

constexpr const char* call_name = "call.txt";

/// A line of text.
std::string line_of(const NamedValue& part) {
  return part.name + ": " + std::to_string(part.value);
}

}  // namespace

void require_same_call(const LockedFolder& folder, const std::vector<NamedValue>& parts) {
  const std::string path = folder.file(call_name);
  if (!folder.has(call_name)) {
    if (!folder.is_empty(call_name))  // it is removed at the end
      throw Error(
          ErrorCode::invalid_argument,
          path + ": is not there, so the folder is for something else; name one that is not there yet");
    FileWriter file(path, FileWriter::Kind::kept);
    for (const NamedValue& part : parts) file.write_all(line_of(part) + "\n");
    file.close();
    return;
  }
  std::vector<std::string> lines;
  std::ifstream file{std::filesystem::path(path)};
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  std::string differ;
  for (const NamedValue& part : parts)
    if (std::find(lines.begin(), lines.end(), line_of(part)) == lines.end())
      differ += (differ.empty() ? "" : ", ") + part.name;
  if (differ.empty()) return;
  throw Error(ErrorCode::invalid_argument,
              path + ": this folder has pieces of another computation, which differs in " + differ +
                  "; repeat that one to finish it, or remove the folder to begin anew");
}

}  // namespace powercell::out_of_core
