#include <algorithm>
#include <powercell/error.hpp>
#include <queue>
#include <tuple>

#include "lib/applications/remeshing/relax.hpp"
#include "lib/applications/remeshing/star.hpp"

namespace powercell::remeshing {
namespace {

using Corners = WorkMesh::Corners;

/// The length of an edge in units of h.
double relative_length(const WorkMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return norm(mesh.at(a) - mesh.at(b)) * 2 / (mesh.vertex(a).h + mesh.vertex(b).h);
}

/// Whether no remaining triangle turns over when vertex a is collapsed into b.
bool keeps_sides(const WorkMesh& mesh, const Surface& surface, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t t : mesh.around(a)) {
    const Corners& row = mesh.triangle(t);
    if (std::find(row.begin(), row.end(), b) != row.end()) continue;
    Corners after = row;
    std::replace(after.begin(), after.end(), a, b);
    if (turns_over(mesh, surface, row, after)) return false;
  }
  return true;
}

/// Collapses edges, the relatively shortest first, until `count` vertices are left or no collapse is
/// possible.
void collapse_shortest(WorkMesh& mesh, const Surface& surface, std::size_t count, std::size_t least_degree,
                       Progress progress) {
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](std::uint32_t a) {
    for (const std::uint32_t b : mesh.neighbors(a)) {
      const double length = relative_length(mesh, a, b);
      queue.emplace(length, a, b);
      queue.emplace(length, b, a);
    }
  };
  for (std::uint32_t a = 0; a < mesh.vertex_count(); ++a)
    if (mesh.is_alive(a)) {
      progress.tick();
      offer(a);
    }
  while (mesh.alive() > count && !queue.empty()) {
    const auto [length, a, b] = queue.top();
    queue.pop();
    progress.tick();
    // Skips entries that are outdated or impossible; a later collapse nearby offers the edge again.
    if (!mesh.is_alive(a) || !mesh.is_alive(b) || !mesh.can_collapse(a, b, least_degree) ||
        !keeps_sides(mesh, surface, a, b))
      continue;
    mesh.collapse(a, b);
    offer(b);
  }
}

/// Splits the relatively longest edge that is not kept.
bool split_longest(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, Progress progress) {
  double longest = 0;
  std::optional<WorkMesh::Edge> found;
  for (std::uint32_t a = 0; a < mesh.vertex_count(); ++a) {
    if (!mesh.is_alive(a)) continue;
    progress.tick();
    for (const std::uint32_t b : mesh.neighbors(a)) {
      if (b < a || mesh.kept(a, b) || relative_length(mesh, a, b) <= longest) continue;
      if (const auto e = mesh.edge(a, b)) {
        longest = relative_length(mesh, a, b);
        found = e;
      }
    }
  }
  if (!found) return false;
  const Place place =
      project(surface, mesh.vertex(found->a).place, (mesh.at(found->a) + mesh.at(found->b)) * 0.5);
  mesh.split(*found, place, sizing.at(surface, place));
  return true;
}

}  // namespace

bool reach_count(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, std::size_t count,
                 Progress progress) {
  // Crowded vertices form shapes that cannot be collapsed; flips in between resolve them.
  for (const std::size_t least_degree : {5, 3})
    for (std::size_t before = 0; mesh.alive() > count && mesh.alive() != before;) {
      before = mesh.alive();
      collapse_shortest(mesh, surface, count + (mesh.alive() - count) / 2, least_degree, progress);
      flip_edges(mesh, surface, progress);
    }
  if (mesh.alive() > count) return false;
  while (mesh.alive() < count) {
    if (!split_longest(mesh, surface, sizing, progress))
      throw Error(ErrorCode::invalid_argument, "too many points: there is no edge left to split");
    flip_edges(mesh, surface, progress);
  }
  return true;
}

}  // namespace powercell::remeshing
