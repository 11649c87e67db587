// Triangles without area: a flip where a corner lies on the opposite edge, a collapse where two corners
// nearly coincide.
#include <algorithm>
#include <iterator>

#include "lib/applications/remeshing/repair_steps.hpp"
#include "lib/applications/remeshing/surface.hpp"

namespace powercell::remeshing {
namespace {

using Corners = std::array<std::uint32_t, 3>;

class Flattener {
 public:
  Flattener(Patchwork& mesh, double rounding, double tiny)
      : mesh_(mesh), rounding_(rounding), tiny_(tiny), around_(mesh.vertex.size()) {
    for (std::uint32_t t = 0; t < mesh.row.size(); ++t)
      for (const std::uint32_t v : mesh.row[t]) around_[v].push_back(t);
  }

  bool is_flat(std::uint32_t t) const {  // or has an edge that is too short
    const Corners& row = mesh_.row[t];
    if (row[0] == row[1]) return false;  // removed
    const Vec a = at(row[0]), b = at(row[1]), c = at(row[2]);
    const double longest2 = std::max({norm2(b - a), norm2(c - b), norm2(a - c)});
    if (std::min({norm2(b - a), norm2(c - b), norm2(a - c)}) <= tiny_ * tiny_) return true;
    const double twice = norm(normal_of(a, b, c)), longest = std::sqrt(longest2);
    // Where all triangles are as small as the rounding it says nothing.
    return !(twice > 1e-12 * longest2) || (twice <= rounding_ * longest && longest >= 100 * rounding_);
  }

  void run(RepairReport& report) {
    std::vector<std::uint32_t> todo;
    for (std::uint32_t t = 0; t < mesh_.row.size(); ++t)
      if (is_flat(t)) todo.push_back(t);
    if (todo.empty()) return;
    std::vector<bool> counted(mesh_.row.size(), false);
    for (std::size_t left = 20 * todo.size() + 100; left > 0 && !todo.empty(); --left) {
      const std::uint32_t t = todo.back();
      todo.pop_back();
      if (!is_flat(t)) continue;
      const Vec place = at(mesh_.row[t][0]);
      touched_.clear();
      if (!remove(t)) continue;
      if (!counted[t]) count(report.flat, place);
      counted[t] = true;
      for (const std::uint32_t s : touched_)
        if (is_flat(s)) todo.push_back(s);
    }
    Rows kept;
    for (std::uint32_t t = 0; t < mesh_.row.size(); ++t) {
      if (is_flat(t)) count(report.left_flat, at(mesh_.row[t][0]));
      if (mesh_.row[t][0] != mesh_.row[t][1]) kept.push_back(mesh_.row[t]);
    }
    mesh_.row = std::move(kept);
  }

 private:
  Vec at(std::uint32_t v) const { return mesh_.vertex[v]; }

  bool remove(std::uint32_t t) {
    const Corners row = mesh_.row[t];
    std::array<double, 3> length{};
    for (std::size_t k = 0; k < 3; ++k) length[k] = norm(at(row[(k + 1) % 3]) - at(row[k]));
    const auto longest =
                   static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin()),
               shortest =
                   static_cast<std::size_t>(std::min_element(length.begin(), length.end()) - length.begin());
    if (length[shortest] <= std::max({rounding_, tiny_, 1e-9 * length[longest]}) &&
        collapse(row[shortest], row[(shortest + 1) % 3]))
      return true;
    return length[shortest] > tiny_ && flip(t, longest);
  }

  /// The triangle behind edge k.
  std::uint32_t behind(std::uint32_t t, std::size_t k) const {
    const std::uint32_t a = mesh_.row[t][k], b = mesh_.row[t][(k + 1) % 3];
    for (const std::uint32_t s : around_[b])
      if (s != t && std::find(mesh_.row[s].begin(), mesh_.row[s].end(), a) != mesh_.row[s].end()) return s;
    return nothing;
  }

  bool flip(std::uint32_t t, std::size_t k) {
    const std::uint32_t a = mesh_.row[t][k], b = mesh_.row[t][(k + 1) % 3], c = mesh_.row[t][(k + 2) % 3];
    const std::uint32_t s = behind(t, k);
    if (s == nothing) {  // at the boundary, which then passes through the corner
      if (around_[c].size() < 2) return false;
      erase(t);
      return true;
    }
    const Corners other = mesh_.row[s];
    std::size_t j = 0;
    while (other[j] == a || other[j] == b) ++j;
    const std::uint32_t d = other[j];
    if (other[(j + 1) % 3] != b || d == c || adjacent(c, d)) return false;
    set(t, {a, d, c});
    set(s, {d, b, c});
    touched_ = {t, s};
    return true;
  }

  /// Moves vertex u to v and removes the triangles at the edge, if the mesh stays a manifold.
  bool collapse(std::uint32_t u, std::uint32_t v) {
    const std::vector<std::uint32_t> of_u = neighbors(u), of_v = neighbors(v);
    std::vector<std::uint32_t> common, gone;
    std::set_intersection(of_u.begin(), of_u.end(), of_v.begin(), of_v.end(), std::back_inserter(common));
    for (const std::uint32_t t : around_[u])
      if (std::find(mesh_.row[t].begin(), mesh_.row[t].end(), v) != mesh_.row[t].end()) gone.push_back(t);
    if (common.size() != gone.size() || of_u.size() + of_v.size() <= 6) return false;
    if (gone.size() == 2 && on_boundary(u) && on_boundary(v)) return false;
    if (on_boundary(u) && !on_boundary(v)) std::swap(u, v);
    for (const std::uint32_t t : gone) erase(t);
    for (const std::uint32_t t : std::vector<std::uint32_t>(around_[u])) {
      Corners row = mesh_.row[t];
      std::replace(row.begin(), row.end(), u, v);
      set(t, row);
      touched_.push_back(t);
    }
    return true;
  }

  bool on_boundary(std::uint32_t v) const { return neighbors(v).size() != around_[v].size(); }

  std::vector<std::uint32_t> neighbors(std::uint32_t v) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t t : around_[v])
      for (const std::uint32_t u : mesh_.row[t])
        if (u != v) result.push_back(u);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  bool adjacent(std::uint32_t a, std::uint32_t b) const {
    const std::vector<std::uint32_t> of_a = neighbors(a);
    return std::binary_search(of_a.begin(), of_a.end(), b);
  }

  void set(std::uint32_t t, const Corners& row) {
    for (const std::uint32_t v : mesh_.row[t])
      if (auto& list = around_[v]; std::find(list.begin(), list.end(), t) != list.end())
        list.erase(std::find(list.begin(), list.end(), t));
    mesh_.row[t] = row;
    if (row[0] == row[1]) return;
    for (const std::uint32_t v : row) around_[v].push_back(t);
  }
  void erase(std::uint32_t t) { set(t, {0, 0, 0}); }

  Patchwork& mesh_;
  double rounding_, tiny_;
  std::vector<std::vector<std::uint32_t>> around_;  // per vertex: its triangles
  std::vector<std::uint32_t> touched_;
};

}  // namespace

void remove_flat(Patchwork& mesh, double rounding, double tiny, RepairReport& report) {
  Flattener(mesh, rounding, tiny).run(report);
}

}  // namespace powercell::remeshing
