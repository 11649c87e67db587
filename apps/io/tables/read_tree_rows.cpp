#include "apps/io/tables/read_tree_rows.hpp"

#include <fmt/format.h>

#include <unordered_map>

#include "apps/io/read/file.hpp"

namespace powercell::io {
namespace {

constexpr const char* implied_root = "0";

class Linker {
 public:
  Linker(std::vector<TreeRow>& rows, const std::string& file, bool lines, const std::string& repeated)
      : rows_(rows), file_(file), repeated_(repeated), lines_(lines) {}

  NamedTree run() {
    if (rows_.empty()) fail_file(file_, "has no rows and therefore no tree");
    index();
    add_implied_root();
    link();
    check_cycles();
    return std::move(tree_);
  }

 private:
  [[noreturn]] void fail(std::size_t row, const std::string& what) const {
    if (lines_) fail_line(file_, rows_[row].place, what);
    fail_file(file_, fmt::format("element {}: {}", rows_[row].place, what));
  }
  std::string place(std::size_t row) const {
    return fmt::format("{} {}", lines_ ? "line" : "element", rows_[row].place);
  }

  void index() {
    at_.reserve(rows_.size());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const auto [known, fresh] = at_.emplace(rows_[k].id, k);
      if (!fresh)
        fail(k, fmt::format("the id '{}' is also that of {}{}{}", rows_[k].id, place(known->second),
                            repeated_.empty() ? "" : "; ", repeated_));
    }
  }

  // Tables may refer to a root 0 that has no row, or have several rows without a parent.
  void add_implied_root() {
    std::size_t roots = 0;
    bool asked = false;
    for (const TreeRow& row : rows_) {
      roots += row.parent.empty() ? 1 : 0;
      asked |= row.parent == implied_root;
    }
    if (roots == 1 || (roots == 0 && (!asked || at_.contains(implied_root)))) return;
    std::string id = implied_root;
    while (at_.contains(id)) id += "#";
    for (TreeRow& row : rows_)
      if (row.parent.empty()) row.parent = id;
    if (roots > 1) tree_.notes.push_back(fmt::format("{} rows have no parent; a root holds them", roots));
    const std::size_t slash = file_.find_last_of('/');
    rows_.push_back({id, "", slash == std::string::npos ? file_ : file_.substr(slash + 1), "", 0, 0});
    at_.emplace(id, rows_.size() - 1);
  }

  void link() {
    for (TreeRow& row : rows_) {
      std::int64_t parent = -1;
      if (!row.parent.empty()) {
        const auto known = at_.find(row.parent);
        if (known == at_.end())
          fail(static_cast<std::size_t>(&row - rows_.data()),
               fmt::format("'{}' has the parent '{}', which has no row; add one, with no parent "
                           "if it is the root",
                           row.id, row.parent));
        parent = static_cast<std::int64_t>(known->second);
      }
      tree_.parent.push_back(parent);
      tree_.value.push_back(row.value);
    }
    tree_.rows = file_ + (lines_ ? ":" : ": element ");
    for (TreeRow& row : rows_) {
      tree_.row.push_back(row.place);
      tree_.colour.push_back(std::move(row.colour));
      tree_.id.push_back(std::move(row.id));
      tree_.name.push_back(row.name.empty() ? tree_.id.back() : std::move(row.name));
    }
  }

  void check_cycles() const {
    const std::size_t n = tree_.parent.size();
    enum : char { unseen, under_way, done };
    std::vector<char> state(n, unseen);
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t i = k;
      for (; state[i] == unseen && tree_.parent[i] >= 0; i = static_cast<std::size_t>(tree_.parent[i]))
        state[i] = under_way;
      if (state[i] == under_way)
        fail(i, fmt::format("'{}' is among its own ancestors (a cycle)", tree_.id[i]));
      state[i] = done;
      for (i = k; state[i] == under_way; i = static_cast<std::size_t>(tree_.parent[i])) state[i] = done;
    }
  }

  std::vector<TreeRow>& rows_;
  const std::string& file_;
  const std::string& repeated_;
  bool lines_;
  std::unordered_map<std::string, std::size_t> at_;
  NamedTree tree_;
};

}  // namespace

NamedTree link_rows(std::vector<TreeRow> rows, const std::string& file, bool lines,
                    const std::string& repeated) {
  return Linker(rows, file, lines, repeated).run();
}

}  // namespace powercell::io
