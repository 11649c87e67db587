// Which edges of triangles are one edge of the surface, and the vertices that follow.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "lib/applications/remeshing/mesh_check.hpp"
#include "lib/applications/remeshing/repair_steps.hpp"
#include "lib/applications/remeshing/surface.hpp"
#include "lib/base/disjoint_sets.hpp"

namespace powercell::remeshing {
namespace {

/// Numbers of points: half-edges with the same two are at one edge.
using VertexList = std::vector<std::uint32_t>;

class Joiner {
 public:
  Joiner(Patchwork& mesh, std::span<const std::uint32_t> same, RepairReport& report)
      : mesh_(mesh),
        report_(report),
        mate_(3 * mesh.row.size(), nothing),
        opposite_(3 * mesh.row.size(), false),
        corners_(3 * mesh.row.size()),
        turned_(mesh.row.size(), false),
        index_(mesh.vertex.size()),
        place_(same.begin(), same.end()) {
    std::iota(index_.begin(), index_.end(), 0u);
  }

  void run(double weld) {
    join_pairs(index_);
    const std::vector<std::vector<std::uint32_t>> crowded = join_pairs(place_);
    orient();
    for (const std::vector<std::uint32_t>& edges : crowded) {
      count(report_.split_edges, mesh_.middle(edges.front()));
      join_around(edges, place_);
    }
    if (weld > 0) weld_open_edges(weld);
    orient();
    make_vertices();
    index_.resize(mesh_.vertex.size());
    std::iota(index_.begin(), index_.end(), 0u);
    split_doubled_edges();
    turn();
  }

 private:
  std::uint64_t key(std::uint32_t h, const VertexList& point) const {
    const auto [a, b] = std::minmax(point[mesh_.from(h)], point[mesh_.to(h)]);
    return edge_key(a, b);
  }

  /// Joins half-edges of which just two are open at an edge.
  /// \return the groups of more
  std::vector<std::vector<std::uint32_t>> join_pairs(const VertexList& point) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> open;
    for (std::uint32_t h = 0; h < mate_.size(); ++h)
      if (mate_[h] == nothing && point[mesh_.from(h)] != point[mesh_.to(h)])
        open.emplace_back(key(h, point), h);
    std::sort(open.begin(), open.end());
    std::vector<std::vector<std::uint32_t>> crowded;
    for (std::size_t first = 0; first < open.size();) {
      std::size_t last = first + 1;
      while (last < open.size() && open[last].first == open[first].first) ++last;
      if (last - first == 2) join(open[first].second, open[first + 1].second, point);
      if (last - first > 2) {
        crowded.emplace_back();
        for (; first < last; ++first) crowded.back().push_back(open[first].second);
      }
      first = last;
    }
    return crowded;
  }

  void join(std::uint32_t h, std::uint32_t g, const VertexList& point) {
    mate_[h] = g;
    mate_[g] = h;
    const auto next = [](std::uint32_t e) { return e % 3 == 2 ? e - 2 : e + 1; };
    const bool opposite = point[mesh_.from(h)] == point[mesh_.to(g)];
    opposite_[h] = opposite_[g] = opposite;
    corners_.unite(h, opposite ? next(g) : g);
    corners_.unite(next(h), opposite ? g : next(g));
  }

  /// Joins half-edges at one edge in pairs that enclose the inside of the surface between them, by the angle
  /// of their triangles around the edge.
  void join_around(const std::vector<std::uint32_t>& edges, const VertexList& point) {
    const std::uint32_t a = mesh_.from(edges.front()), b = mesh_.to(edges.front());
    const Vec axis = unit(mesh_.vertex[b] - mesh_.vertex[a]);
    const Vec side = std::fabs(axis.x) < 0.6 ? Vec{1, 0, 0} : Vec{0, 1, 0};
    const Vec u = unit(cross(axis, side)), v = cross(axis, u);
    struct Page {
      double angle;
      std::uint32_t edge;
      bool inside_follows;  // at larger angles
    };
    std::vector<Page> pages;
    for (const std::uint32_t h : edges) {
      const Vec to = mesh_.vertex[mesh_.apex(h)] - mesh_.vertex[a];
      const bool along = (point[mesh_.from(h)] == point[a]) != turned_[h / 3];
      pages.push_back({std::atan2(dot(to, v), dot(to, u)), h, !along});
    }
    std::sort(pages.begin(), pages.end(), [](const Page& p, const Page& q) {
      return p.angle != q.angle ? p.angle < q.angle : p.edge < q.edge;
    });
    std::vector<std::size_t> opened;
    for (std::size_t k = 0; k < 2 * pages.size(); ++k) {  // twice around
      const Page& page = pages[k % pages.size()];
      if (mate_[page.edge] != nothing) continue;
      if (page.inside_follows) {
        if (k < pages.size()) opened.push_back(k);
      } else if (!opened.empty()) {
        join(pages[opened.back()].edge, page.edge, point);
        opened.pop_back();
      }
    }
  }

  /// Decides which triangles to turn, so that all of a part are oriented as most of it, or else as its first.
  void orient() {
    std::vector<bool> seen(mesh_.row.size(), false);
    turned_.assign(mesh_.row.size(), false);
    std::vector<std::uint32_t> part;
    for (std::uint32_t first = 0; first < mesh_.row.size(); ++first) {
      if (seen[first]) continue;
      seen[first] = true;
      part.assign(1, first);
      std::size_t turned = 0;
      for (std::size_t k = 0; k < part.size(); ++k) {
        const std::uint32_t t = part[k];
        turned += turned_[t];
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
          if (mate_[h] == nothing || seen[mate_[h] / 3]) continue;
          const std::uint32_t other = mate_[h] / 3;
          seen[other] = true;
          turned_[other] = turned_[t] == opposite_[h];
          part.push_back(other);
        }
      }
      if (2 * turned > part.size())
        for (const std::uint32_t t : part) turned_[t] = !turned_[t];
    }
  }

  /// Joins open edges whose ends are near to each other.
  void weld_open_edges(double weld) {
    std::vector<double> reach(mesh_.vertex.size(), -1);  // per point of an open edge
    for (std::uint32_t h = 0; h < mate_.size(); ++h)
      if (mate_[h] == nothing) reach[place_[mesh_.from(h)]] = reach[place_[mesh_.to(h)]] = weld;
    for (std::uint32_t h = 0; h < mate_.size(); ++h) {
      const double most = norm(mesh_.vertex[mesh_.from(h)] - mesh_.vertex[mesh_.to(h)]) / 4;
      for (const std::uint32_t v : {place_[mesh_.from(h)], place_[mesh_.to(h)]})
        reach[v] = std::min(reach[v], most);
    }
    const VertexList cluster = clusters(reach, weld);
    const std::size_t before = open_edges();
    const std::vector<std::vector<std::uint32_t>> crowded = join_pairs(cluster);
    for (const std::vector<std::uint32_t>& edges : crowded) join_around(edges, cluster);
    report_.welded.count = (before - open_edges()) / 2;
    for (std::uint32_t h = 0; h < mate_.size() && report_.welded.count > 0; ++h)
      if (mate_[h] != nothing && key(h, place_) != key(mate_[h], place_)) {
        const Vec at = mesh_.middle(h);
        report_.welded.first = {at.x, at.y, at.z};
        return;
      }
  }

  std::size_t open_edges() const {
    return static_cast<std::size_t>(std::count(mate_.begin(), mate_.end(), nothing));
  }

  /// Numbers the points so that those within reach of each other have the same number.
  VertexList clusters(const std::vector<double>& reach, double weld) const {
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cube;
    const auto key = [](std::int64_t x, std::int64_t y, std::int64_t z) {
      return (static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^ static_cast<std::uint64_t>(y)) *
                 0xbf58476d1ce4e5b9u ^
             static_cast<std::uint64_t>(z);
    };
    DisjointSets sets(mesh_.vertex.size());
    for (std::uint32_t p = 0; p < reach.size(); ++p) {
      if (reach[p] < 0) continue;
      const Vec at = mesh_.vertex[p];
      const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / weld)); };
      const std::int64_t x = cell(at.x), y = cell(at.y), z = cell(at.z);
      for (std::int64_t i = x - 1; i <= x + 1; ++i)
        for (std::int64_t j = y - 1; j <= y + 1; ++j)
          for (std::int64_t k = z - 1; k <= z + 1; ++k) {
            const auto found = cube.find(key(i, j, k));
            if (found == cube.end()) continue;
            for (const std::uint32_t q : found->second)
              if (norm(mesh_.vertex[q] - at) <= std::min(reach[p], reach[q])) sets.unite(p, q);
          }
      cube[key(x, y, z)].push_back(p);
    }
    VertexList cluster(mesh_.vertex.size());
    for (std::uint32_t v = 0; v < cluster.size(); ++v) cluster[v] = sets.root(place_[v]);
    return cluster;
  }

  /// Gives each set of corners a vertex: the first of those that they had, or a new one if another set has
  /// it.
  void make_vertices() {
    const std::size_t given = mesh_.vertex.size();
    std::vector<std::uint32_t> least(corners_.size(), nothing), number(corners_.size(), nothing);
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      std::uint32_t& v = least[corners_.root(c)];
      v = std::min(v, mesh_.from(c));
    }
    std::vector<std::uint32_t> sheets(given, 0);
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      const std::uint32_t root = corners_.root(c);
      if (number[root] != nothing) continue;
      number[root] = least[root];
      if (++sheets[least[root]] == 1) continue;
      number[root] = static_cast<std::uint32_t>(mesh_.vertex.size());
      mesh_.vertex.push_back(mesh_.vertex[least[root]]);
      if (sheets[least[root]] == 2) count(report_.split_vertices, mesh_.vertex[least[root]]);
    }
    Rows row(mesh_.row.size());
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      const std::uint32_t v = number[corners_.root(c)];
      row[c / 3][c % 3] = v;
      report_.moved = std::max(report_.moved, norm(mesh_.vertex[v] - mesh_.vertex[mesh_.from(c)]));
    }
    mesh_.row = std::move(row);
  }

  void turn() {
    for (std::uint32_t t = 0; t < mesh_.row.size(); ++t) {
      if (!turned_[t]) continue;
      auto& [a, b, c] = mesh_.row[t];
      std::swap(b, c);
      count(report_.turned, mesh_.vertex[a]);
    }
  }

  /// Two edges that are not joined may have the same ends, as a fin has on the surface it stands on. All but
  /// one of them get a vertex in the middle.
  void split_doubled_edges() {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> edges;  // one half-edge of each
    for (std::uint32_t h = 0; h < mate_.size(); ++h)
      if (mate_[h] == nothing || h < mate_[h]) edges.emplace_back(key(h, index_), h);
    std::sort(edges.begin(), edges.end());
    std::unordered_map<std::uint32_t, std::uint32_t> middle;  // per half-edge
    for (std::size_t k = 1; k < edges.size(); ++k) {
      if (edges[k].first != edges[k - 1].first) continue;
      const std::uint32_t h = edges[k].second;
      middle[h] = static_cast<std::uint32_t>(mesh_.vertex.size());
      if (mate_[h] != nothing) middle[mate_[h]] = middle[h];
      mesh_.vertex.push_back(mesh_.middle(h));
    }
    if (middle.empty()) return;
    Rows row;
    std::vector<bool> turned;
    for (std::uint32_t t = 0; t < mesh_.row.size(); ++t) {
      std::array<std::uint32_t, 3> cut{};
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto at = middle.find(3 * t + k);
        cut[k] = at == middle.end() ? nothing : at->second;
      }
      append_cut(mesh_.row[t], cut, row);
      turned.resize(row.size(), turned_[t]);
    }
    mesh_.row = std::move(row);
    turned_ = std::move(turned);
  }

  /// Appends a triangle cut at points on its edges.
  static void append_cut(const std::array<std::uint32_t, 3>& row, const std::array<std::uint32_t, 3>& cut,
                         Rows& to) {
    std::size_t k = 0;
    while (k < 3 && cut[k] == nothing) ++k;
    if (k == 3) {
      to.push_back(row);
      return;
    }
    const std::uint32_t a = row[k], b = row[(k + 1) % 3], c = row[(k + 2) % 3], m = cut[k];
    append_cut({a, m, c}, {nothing, nothing, cut[(k + 2) % 3]}, to);
    append_cut({m, b, c}, {nothing, cut[(k + 1) % 3], nothing}, to);
  }

  Patchwork& mesh_;
  RepairReport& report_;
  std::vector<std::uint32_t> mate_;  // per half-edge: the one that it is joined to
  std::vector<bool> opposite_;       // whether that one runs the other way
  DisjointSets corners_;             // per half-edge, for the corner that it starts at
  std::vector<bool> turned_;         // per triangle, to be oriented as its part
  VertexList index_, place_;
};

}  // namespace

void join_edges(Patchwork& mesh, std::span<const std::uint32_t> same, double weld, RepairReport& report) {
  Joiner(mesh, same, report).run(weld);
}

}  // namespace powercell::remeshing
