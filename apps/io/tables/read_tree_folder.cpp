// The sizes of the files below a folder.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/io/read/file.hpp"
#include "apps/io/tables/read_tree_rows.hpp"

namespace powercell::io {
namespace {

namespace fs = std::filesystem;

struct Entry {
  fs::path path;
  bool folder;
  double size;
};

// The entries of a folder sorted by name, so that the same folder gives the same tree.
std::vector<Entry> list(const fs::path& folder, std::error_code& error) {
  std::vector<Entry> entries;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;  // entries that vanish meanwhile are omitted
    const fs::file_status status = at->symlink_status(gone);
    if (gone || (!fs::is_directory(status) && !fs::is_regular_file(status))) continue;
    const bool is_folder = fs::is_directory(status);
    const std::uintmax_t size = is_folder ? 0 : at->file_size(gone);
    if (!gone) entries.push_back({at->path(), is_folder, static_cast<double>(size)});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.path < b.path; });
  return entries;
}

}  // namespace

NamedTree scan_folder(const std::string& path) {
  NamedTree tree;
  const auto add = [&](const std::string& id, const std::string& name, std::int64_t parent, double value) {
    tree.id.push_back(id);
    tree.name.push_back(name);
    tree.parent.push_back(parent);
    tree.value.push_back(value);
  };
  fs::path root = fs::path(path).lexically_normal();
  if (!root.has_filename()) root = root.parent_path();
  const std::string name = root.filename().string();
  add(".",
      name.empty() || name == "." ? fs::absolute(path).lexically_normal().parent_path().filename().string()
                                  : name,
      -1, 0);
  std::vector<fs::path> folder_of = {fs::path(path)};
  std::vector<std::size_t> node_of = {0};
  std::size_t unread = 0;
  for (std::size_t k = 0; k < folder_of.size(); ++k) {
    std::error_code error;
    const std::size_t above = node_of[k];
    const std::vector<Entry> entries = list(folder_of[k], error);
    if (error && k == 0) fail_file(path, "cannot be read: " + error.message());
    if (error) ++unread;
    for (const Entry& entry : entries) {
      const std::string own = entry.path.filename().string();
      if (entry.folder) {
        folder_of.push_back(entry.path);
        node_of.push_back(tree.size());
      }
      add(above == 0 ? own : tree.id[above] + "/" + own, own, static_cast<std::int64_t>(above), entry.size);
    }
  }
  if (unread > 0) tree.notes.push_back(fmt::format("{} folders could not be read and are omitted", unread));
  return tree;
}

}  // namespace powercell::io
