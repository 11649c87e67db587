// A sweep over the vertices in lexicographic order, which is that of their numbers. It keeps the edges that
// the sweep line crosses, from bottom to top. Edges that cross are neighbours before they do (Shamos and
// Hoey, 1976), and the order of two neighbours changes between here and the end of one of them exactly if
// they cross. All decisions are turns of three vertices: places where edges cross are never computed.
//
// Every edge says what is on both of its sides: its part on one, what is outside this part on the other. If
// neighbours agree about what is between them wherever the line is, then each place is in at most one part,
// from the unbounded outside on.
#include "lib/domain/polygon_check.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "lib/base/disjoint_sets.hpp"
#include "lib/domain/orientation.hpp"
#include "lib/domain/polygon_faults.hpp"

namespace powercell {
namespace {

constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

/// An edge that the sweep line crosses, and one of another part that lies on it with its inside on the other
/// side.
struct Line {
  std::uint32_t edge = nothing, other = nothing;
};

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorCode::invalid_domain, why);
}

class Check {
 public:
  explicit Check(const IndexedRings& rings);
  std::vector<Touch> run();

 private:
  struct Point {
    std::uint32_t vertex;
  };
  /// The order of lines, by their numbers, and of a point among them.
  struct Below {
    using is_transparent = void;
    const Check* check;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
      return check->below(check->lines_[a].edge, check->lines_[b].edge);
    }
    bool operator()(std::uint32_t a, Point p) const {
      return check->turn_at(check->lines_[a].edge, p.vertex) > 0;
    }
    bool operator()(Point p, std::uint32_t a) const {
      return check->turn_at(check->lines_[a].edge, p.vertex) < 0;
    }
  };
  using Status = std::set<std::uint32_t, Below>;
  using Place = Status::iterator;

  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orient2d(rings_.at(a), rings_.at(b), rings_.at(c));
  }
  int turn_at(std::uint32_t e, std::uint32_t v) const { return turn(edges_[e].left, edges_[e].right, v); }
  bool below(std::uint32_t e, std::uint32_t f) const;

  std::uint32_t part(std::uint32_t e) const { return rings_.rings[edges_[e].ring].part; }
  std::uint32_t part_above(Line line) const {
    if (edges_[line.edge].inside_above) return part(line.edge);
    return line.other == nothing ? nothing : part(line.other);
  }
  std::uint32_t part_below(Line line) const {
    if (!edges_[line.edge].inside_above) return part(line.edge);
    return line.other == nothing ? nothing : part(line.other);
  }

  void add_edges();
  void sort_starts();
  std::span<const std::uint32_t> starts(std::uint32_t v) const {
    return std::span(start_).subspan(first_start_[v], first_start_[v + 1] - first_start_[v]);
  }

  void pass(std::uint32_t v);
  std::pair<Place, Place> lines_through(std::uint32_t v) const;
  void look_back(std::uint32_t v, Place first, Place last);
  void look_ahead(std::uint32_t v);
  void join(Line& line, std::uint32_t e, std::uint32_t v);
  Place replace(Place first, Place last);
  void check_order(Place a, Place b) const;
  void check_sides(std::uint32_t v, Place first, Place last);
  std::optional<std::string> describe(std::uint32_t v, Place first, Place last) const;
  void check_rings(std::uint32_t v);

  const IndexedRings& rings_;
  PolygonFaults faults_;
  std::vector<RingEdge> edges_;
  std::vector<std::uint32_t> start_,
      first_start_;                    // edges by left end, from bottom to top; the first of each vertex
  std::vector<std::uint32_t> ending_;  // an edge that ends at a vertex
  std::vector<Line> lines_;
  std::vector<Place> place_;            // of each line in the status
  std::vector<std::uint32_t> line_of_;  // of each edge
  std::vector<std::uint32_t> free_;     // numbers of lines that are not in use
  Status status_;
  DisjointSets chained_;  // rings that touch
  std::vector<Touch> touches_;
  std::optional<std::string> fault_, cut_;  // the first of each; what is found at once counts more

  // At the vertex that is passed: the edges that go through it, the lines on its right, and the rings of all
  // edges there, one of each edge that begins or ends.
  std::vector<std::uint32_t> passing_;
  std::vector<Line> ahead_;
  std::vector<std::uint32_t> rings_here_;
};

Check::Check(const IndexedRings& rings)
    : rings_(rings), faults_(rings), status_(Below{this}), chained_(rings.rings.size()) {
  add_edges();
  sort_starts();
  line_of_.resize(edges_.size());
}

void Check::add_edges() {
  std::size_t count = 0;
  for (const IndexedRing& ring : rings_.rings) count += ring.vertex.size();
  if (count >= nothing) refuse("a polygon can have at most 2^32 edges");
  edges_.reserve(count);
  ending_.assign(rings_.vertex_count(), nothing);
  for (std::uint32_t r = 0; r < rings_.rings.size(); ++r) {
    const std::vector<std::uint32_t>& ring = rings_.rings[r].vertex;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::uint32_t a = ring[k], b = ring[k + 1 == ring.size() ? 0 : k + 1];
      ending_[std::max(a, b)] = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back({std::min(a, b), std::max(a, b), r, a < b});
    }
  }
}

void Check::sort_starts() {
  const std::size_t vertices = rings_.vertex_count();
  first_start_.assign(vertices + 1, 0);
  for (const RingEdge& edge : edges_) ++first_start_[edge.left + 1];
  for (std::size_t v = 0; v < vertices; ++v) first_start_[v + 1] += first_start_[v];
  start_.resize(edges_.size());
  std::vector<std::uint32_t> next(first_start_.begin(), first_start_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) start_[next[edges_[e].left]++] = e;
  for (std::size_t v = 0; v < vertices; ++v) {
    if (first_start_[v + 1] - first_start_[v] < 2) continue;
    std::sort(start_.begin() + first_start_[v], start_.begin() + first_start_[v + 1],
              [&](std::uint32_t e, std::uint32_t f) { return turn_at(e, edges_[f].right) > 0; });
  }
}

/// Whether e is below f where both have begun and none has ended.
bool Check::below(std::uint32_t e, std::uint32_t f) const {
  const RingEdge &a = edges_[e], &b = edges_[f];
  if (a.left > b.left) {
    const int side = turn_at(f, a.left);
    return (side != 0 ? side : turn_at(f, a.right)) < 0;
  }
  const int side = turn_at(e, b.left);
  return (side != 0 ? side : turn_at(e, b.right)) > 0;
}

std::vector<Touch> Check::run() {
  for (std::uint32_t v = 0; v < rings_.vertex_count(); ++v) pass(v);
  if (fault_) refuse(*fault_);
  if (cut_) refuse(*cut_);
  std::ranges::sort(touches_);
  return std::move(touches_);
}

/// Moves the sweep line over v.
void Check::pass(std::uint32_t v) {
  auto [first, last] = lines_through(v);
  look_back(v, first, last);
  look_ahead(v);
  first = replace(first, last);
  if (first != status_.begin()) check_order(std::prev(first), first);
  if (first != last) check_order(std::prev(last), last);
  check_sides(v, first, last);
  if (rings_here_.size() > 2) check_rings(v);
}

/// The lines that v lies on, which are neighbours.
std::pair<Check::Place, Check::Place> Check::lines_through(std::uint32_t v) const {
  const auto on = [&](std::uint32_t line) {
    return edges_[lines_[line].edge].right == v || turn_at(lines_[line].edge, v) == 0;
  };
  Place first = ending_[v] == nothing ? status_.lower_bound(Point{v}) : place_[line_of_[ending_[v]]];
  Place last = first;
  while (last != status_.end() && on(*last)) ++last;
  if (ending_[v] != nothing)
    while (first != status_.begin() && on(*std::prev(first))) --first;
  return {first, last};
}

/// Collects the edges that end at v or go through it.
void Check::look_back(std::uint32_t v, Place first, Place last) {
  passing_.clear();
  rings_here_.clear();
  for (Place line = first; line != last; ++line) {
    const std::size_t before = passing_.size();
    for (const std::uint32_t e : {lines_[*line].edge, lines_[*line].other}) {
      if (e == nothing) continue;
      rings_here_.push_back(edges_[e].ring);
      if (edges_[e].right == v) continue;
      if (before > 0) refuse(faults_.crossing(edges_[passing_[0]], edges_[e], v));
      rings_here_.push_back(edges_[e].ring);
      passing_.push_back(e);
      touches_.push_back({e, v});
    }
  }
}

/// Collects the lines that go on from v.
void Check::look_ahead(std::uint32_t v) {
  ahead_.clear();
  const Line through = {passing_.empty() ? nothing : passing_[0],
                        passing_.size() < 2 ? nothing : passing_[1]};
  bool is_in = passing_.empty();
  for (const std::uint32_t e : starts(v)) {
    rings_here_.push_back(edges_[e].ring);
    if (!is_in && turn_at(through.edge, edges_[e].right) >= 0) {
      ahead_.push_back(through);
      is_in = true;
    }
    if (!ahead_.empty() && turn_at(ahead_.back().edge, edges_[e].right) == 0)
      join(ahead_.back(), e, v);
    else
      ahead_.push_back({e, nothing});
  }
  if (!is_in) ahead_.push_back(through);
}

/// Adds an edge that lies on a line from v on.
void Check::join(Line& line, std::uint32_t e, std::uint32_t v) {
  for (const std::uint32_t f : {line.edge, line.other})
    if (f != nothing && part(f) == part(e)) refuse(faults_.common_edge(edges_[f], edges_[e], v));
  for (const std::uint32_t f : {line.edge, line.other}) {
    if (f == nothing || edges_[f].inside_above != edges_[e].inside_above) continue;
    if (!fault_) fault_ = faults_.common_edge(edges_[f], edges_[e], v);
  }
  if (line.other != nothing) refuse(*fault_);  // of three edges two have their insides on the same side
  line.other = e;
}

/// Replaces lines of the status by those ahead; returns the first of these.
Check::Place Check::replace(Place first, Place last) {
  const bool is_first = first == status_.begin();
  const Place before = is_first ? first : std::prev(first);
  for (const Line& line : ahead_) {
    std::uint32_t number = 0;
    if (first != last) {
      number = *first++;
      lines_[number] = line;
    } else {
      if (free_.empty()) {
        free_.push_back(static_cast<std::uint32_t>(lines_.size()));
        lines_.emplace_back();
        place_.emplace_back();
      }
      number = free_.back();
      free_.pop_back();
      lines_[number] = line;
      place_[number] = status_.emplace_hint(last, number);
    }
    line_of_[line.edge] = number;
    if (line.other != nothing) line_of_[line.other] = number;
  }
  while (first != last) {
    free_.push_back(*first);
    first = status_.erase(first);
  }
  return is_first ? status_.begin() : std::next(before);
}

/// Refuses neighbours that cross.
/// \param a  the lower one, or the end
void Check::check_order(Place a, Place b) const {
  if (a == status_.end() || b == status_.end()) return;
  const RingEdge &e = edges_[lines_[*a].edge], &f = edges_[lines_[*b].edge];
  const bool cross = e.right < f.right ? turn(f.left, f.right, e.right) > 0
                                       : e.right > f.right && turn(e.left, e.right, f.right) < 0;
  if (cross) refuse(faults_.crossing(e, f));
}

/// Notes a fault if lines on the right of v, the first and last of which are given, and their neighbours do
/// not agree about what is between them.
void Check::check_sides(std::uint32_t v, Place first, Place last) {
  if (fault_) return;
  std::uint32_t between = first == status_.begin() ? nothing : part_above(lines_[*std::prev(first)]);
  bool agree = true;
  for (Place line = first; line != last; ++line) {
    agree = agree && part_below(lines_[*line]) == between;
    between = part_above(lines_[*line]);
  }
  agree = agree && between == (last == status_.end() ? nothing : part_below(lines_[*last]));
  if (!agree) fault_ = describe(v, first, last);
}

/// What is wrong between lines on the right of v.
std::optional<std::string> Check::describe(std::uint32_t v, Place first, Place last) const {
  std::map<std::uint32_t, int> winding;
  const auto cross = [&](Place line) {
    for (const std::uint32_t e : {lines_[*line].edge, lines_[*line].other})
      if (e != nothing) winding[edges_[e].ring] += edges_[e].inside_above ? 1 : -1;
  };
  for (Place line = status_.begin(); line != first; ++line) cross(line);
  for (Place line = first; line != last; ++line) {
    cross(line);
    if (auto fault = faults_.around(winding, v)) return fault;
  }
  return "the rings of the polygon do not bound a region at " + place(rings_.at(v)[0], rings_.at(v)[1]);
}

/// Where rings touch: each may come to v once, and those of a part must not close a chain.
void Check::check_rings(std::uint32_t v) {
  std::ranges::sort(rings_here_);
  for (std::size_t k = 0; k < rings_here_.size(); k += 2) {
    const std::uint32_t ring = rings_here_[k];
    if (k + 2 < rings_here_.size() && rings_here_[k + 2] == ring) refuse(faults_.meets_itself(ring, v));
    if (k == 0 || rings_.rings[rings_here_[k - 2]].part != rings_.rings[ring].part) continue;
    if (chained_.root(rings_here_[k - 2]) == chained_.root(ring)) {
      if (!cut_) cut_ = faults_.cut_in_pieces(rings_.rings[ring].part, v);
    }
    chained_.unite(rings_here_[k - 2], ring);
  }
}

}  // namespace

std::vector<Touch> check_polygon(const IndexedRings& rings) {
  return Check(rings).run();
}

void split_touched_edges(IndexedRings& rings, std::span<const Touch> touches) {
  std::vector<std::uint32_t> with_all;
  std::size_t edge = 0;
  auto touch = touches.begin();
  for (IndexedRing& ring : rings.rings) {
    const std::size_t end = edge + ring.vertex.size();
    if (touch == touches.end() || touch->edge >= end) {
      edge = end;
      continue;
    }
    with_all.clear();
    for (std::size_t k = 0; k < ring.vertex.size(); ++k, ++edge) {
      const std::uint32_t a = ring.vertex[k], b = ring.vertex[(k + 1) % ring.vertex.size()];
      with_all.push_back(a);
      const auto on_edge = static_cast<std::ptrdiff_t>(with_all.size());
      for (; touch != touches.end() && touch->edge == edge; ++touch) with_all.push_back(touch->vertex);
      // Vertices are in lexicographic order, so also along the edge.
      if (b < a) std::reverse(with_all.begin() + on_edge, with_all.end());
    }
    ring.vertex = with_all;
  }
}

}  // namespace powercell
