// The first loop of the greedy homology basis (J. Erickson, K. Whittlesey, Greedy optimal homotopy and
// homology generators, SODA 2005) on the graph of the pieces of a cell.
#include "lib/applications/remeshing/cell_loop.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_map>

namespace powercell::remeshing {
namespace {

constexpr std::uint64_t outside = ~std::uint64_t{0};
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two adjacent pieces of the cells.
struct Join {
  std::uint32_t p, q;                ///< indices among the pieces
  Vec middle;                        ///< of the edge they share
  bool kept;                         ///< that edge is on a kept edge of the surface
  std::array<std::uint64_t, 2> end;  ///< vertices at its ends, or `outside`
};

struct Segment {
  std::uint32_t triangle;
  Vec from, to;
  bool ends_on_kept = false;  ///< `to` is on a kept edge of the surface
};

struct Loop {
  double away = 0;  ///< distance from the start, within the cells
  std::vector<Segment> segment;
};

class Cells {
 public:
  Cells(const LocalDiagram& diagram, std::vector<std::uint32_t> seeds, const Place& from)
      : diagram_(diagram), seed_(std::move(seeds)) {
    for (const std::uint32_t seed : seed_)
      for (const std::uint32_t p : diagram.pieces(seed)) {
        const Piece& piece = diagram.piece(p);
        number_[p] = static_cast<std::uint32_t>(piece_.size());
        piece_.push_back(p);
        Vec sum;
        for (const Corner& corner : piece.ring) sum += corner.at;
        centre_.push_back(sum * (1 / static_cast<double>(piece.ring.size())));
      }
    if (const auto at = find(from.triangle, seed_.front()); at != nothing) {
      start_ = at;
      centre_[start_] = from.at;
    }
    for (std::uint32_t p = 0; p < piece_.size(); ++p) find_joins(p);
  }

  /// The shortest loop that is not a sum of loops around vertices of the surface and of loops along walls.
  Loop loop() {
    if (start_ == nothing) return {};
    find_paths();
    std::vector<std::pair<double, std::size_t>> closing;  // loops, by their join that is on no shortest path
    for (std::size_t j = 0; j < join_.size(); ++j)
      if (const Join& join = join_[j];
          distance_[join.p] < infinity && back_[join.p] != j && back_[join.q] != j)
        closing.emplace_back(distance_[join.p] + length(join) + distance_[join.q], j);
    std::sort(closing.begin(), closing.end(), std::greater<>());
    // Loops that generate those around vertices and along walls are no generators of the homology: a maximum
    // spanning tree of the dual graph consists of them.
    std::size_t shortest = none;
    for (const auto& [length, j] : closing) {
      const std::uint32_t a = root(node(join_[j].end[0])), b = root(node(join_[j].end[1]));
      if (a == b)
        shortest = j;
      else
        parent_[a] = b;
    }
    return shortest == none ? Loop{} : loop_through(shortest);
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  const Piece& piece(std::uint32_t p) const { return diagram_.piece(piece_[p]); }

  /// The piece of a seed in a triangle.
  std::uint32_t find(std::uint32_t triangle, std::uint32_t seed) const {
    for (const std::uint32_t p : diagram_.pieces_in(triangle))
      if (diagram_.piece(p).seed == seed) return number_.at(p);
    return nothing;
  }

  bool is_ours(int behind) const {
    return behind >= 0 &&
           std::find(seed_.begin(), seed_.end(), static_cast<std::uint32_t>(behind)) != seed_.end();
  }

  /// The vertex where edge `in` of a piece ends and edge `out` starts; `outside` on the boundary of the
  /// cells.
  std::uint64_t vertex_between(std::uint32_t triangle, int in, int out) const {
    const auto& row = diagram_.surface().triangle[triangle];
    if (in < 0 && out < 0) return row[static_cast<std::size_t>(~out)];
    if ((in < 0 && is_ours(out)) ||
        (out < 0 && is_ours(in))) {  // a wall between the two cells meets an edge of the surface
      const auto k = static_cast<std::size_t>(~std::min(in, out));
      const auto [a, b] = std::minmax(row[k], row[(k + 1) % 3]);
      return (std::uint64_t{a} + 1) << 32 | b;
    }
    return outside;
  }

  void find_joins(std::uint32_t p) {
    const Surface& surface = diagram_.surface();
    const Piece& piece = this->piece(p);
    const std::size_t n = piece.ring.size();
    for (std::size_t v = 0; v < n; ++v) {
      const int before = piece.ring[(v + n - 1) % n].edge, here = piece.ring[v].edge,
                after = piece.ring[(v + 1) % n].edge;
      const std::array<std::uint64_t, 2> end{vertex_between(piece.triangle, before, here),
                                             vertex_between(piece.triangle, here, after)};
      if (here >= 0 && !is_ours(here)) continue;
      const std::uint32_t across =
          here >= 0 ? piece.triangle : surface.across[piece.triangle][static_cast<std::size_t>(~here)];
      const std::uint32_t q = across == nothing
                                  ? nothing
                                  : find(across, here >= 0 ? static_cast<std::uint32_t>(here) : piece.seed);
      if (q == nothing)  // the boundary of the surface, or a wall along an edge that rounding has displaced
        for (const std::uint64_t u : end) join_nodes(node(u), node(outside));
      else if (p < q)
        join_.push_back({p, q, (piece.ring[v].at + piece.ring[(v + 1) % n].at) * 0.5,
                         here < 0 && surface.kept[piece.triangle][static_cast<std::size_t>(~here)], end});
    }
  }

  double length(const Join& join) const {
    return norm(centre_[join.p] - join.middle) + norm(join.middle - centre_[join.q]);
  }

  /// Dijkstra's algorithm from the piece with the start.
  void find_paths() {
    std::vector<std::vector<std::size_t>> at(centre_.size());
    for (std::size_t j = 0; j < join_.size(); ++j) {
      at[join_[j].p].push_back(j);
      at[join_[j].q].push_back(j);
    }
    distance_.assign(centre_.size(), infinity);
    back_.assign(centre_.size(), none);
    distance_[start_] = 0;
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    queue.emplace(0, start_);
    while (!queue.empty()) {
      const auto [distance, p] = queue.top();
      queue.pop();
      if (distance > distance_[p]) continue;
      for (const std::size_t j : at[p]) {
        const std::uint32_t q = other(j, p);
        if (distance + length(join_[j]) >= distance_[q]) continue;
        distance_[q] = distance + length(join_[j]);
        back_[q] = j;
        queue.emplace(distance_[q], q);
      }
    }
  }

  std::uint32_t other(std::size_t j, std::uint32_t p) const {
    return join_[j].p == p ? join_[j].q : join_[j].p;
  }

  /// The joins from a piece back to the start.
  std::vector<std::size_t> path(std::uint32_t p) const {
    std::vector<std::size_t> joins;
    for (; p != start_; p = other(joins.back(), p)) joins.push_back(back_[p]);
    return joins;
  }

  /// The loop of join j and the two shortest paths from its ends, without their common part.
  Loop loop_through(std::size_t j) const {
    std::vector<std::size_t> round = path(join_[j].p), back = path(join_[j].q);
    while (!round.empty() && !back.empty() && round.back() == back.back()) {
      round.pop_back();
      back.pop_back();
    }
    std::uint32_t at = join_[j].p;
    for (const std::size_t k : round) at = other(k, at);
    Loop loop{distance_[at], {}};
    std::reverse(round.begin(), round.end());
    round.push_back(j);
    round.insert(round.end(), back.begin(), back.end());
    for (const std::size_t k : round) {
      loop.segment.push_back({piece(at).triangle, centre_[at], join_[k].middle, join_[k].kept});
      at = other(k, at);
      loop.segment.push_back({piece(at).triangle, join_[k].middle, centre_[at]});
    }
    return loop;
  }

  /// Disjoint sets of the vertices of the cells, with all of their boundary as one vertex.
  std::uint32_t node(std::uint64_t vertex) {
    const auto [at, added] = node_.try_emplace(vertex, static_cast<std::uint32_t>(parent_.size()));
    if (added) parent_.push_back(at->second);
    return at->second;
  }
  std::uint32_t root(std::uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void join_nodes(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

  const LocalDiagram& diagram_;
  std::vector<std::uint32_t> seed_;
  std::vector<std::uint32_t> piece_;                         ///< the pieces of all cells
  std::unordered_map<std::uint32_t, std::uint32_t> number_;  ///< index in piece_
  std::uint32_t start_ = nothing;
  std::vector<Vec> centre_;
  std::vector<Join> join_;
  std::vector<double> distance_;   ///< per piece: from the start
  std::vector<std::size_t> back_;  ///< per piece: the join towards the start
  std::unordered_map<std::uint64_t, std::uint32_t> node_;
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<Place> points_around(const LocalDiagram& diagram, std::uint32_t seed, const Place& from) {
  const Loop loop = Cells(diagram, {seed}, from).loop();
  double length = 0;
  for (const Segment& s : loop.segment) length += norm(s.to - s.from);
  // Three points around; the seed is one of them if the loop starts near it.
  std::vector<double> wanted{length / 3, length * 2 / 3};
  if (loop.away > length / 6) wanted.push_back(length);
  std::vector<Place> result;
  double before = 0;
  for (const Segment& s : loop.segment) {
    const double step = norm(s.to - s.from);
    while (result.size() < wanted.size() && step > 0 && wanted[result.size()] <= before + step)
      result.push_back({s.triangle, s.from + (s.to - s.from) * ((wanted[result.size()] - before) / step)});
    before += step;
  }
  return result;
}

Place point_between(const LocalDiagram& diagram, std::uint32_t a, std::uint32_t b, const Place& from) {
  const Loop loop = Cells(diagram, {a, b}, from).loop();
  Place best;
  double most = 0;
  for (const Segment& s : loop.segment) {
    const double distance = std::min(norm2(s.to - diagram.seed(a).at), norm2(s.to - diagram.seed(b).at));
    if (s.ends_on_kept || distance <= most) continue;  // kept edges are left to the seeds of their curves
    most = distance;
    best = {s.triangle, s.to};
  }
  return best;
}

}  // namespace powercell::remeshing
