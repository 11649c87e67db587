#include "apps/io/write/shared_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <powercell/error.hpp>
#include <powercell/regions.hpp>
#include <unordered_map>
#include <utility>

#include "apps/io/groups.hpp"

namespace powercell::io {
namespace {

/// One of the things that meet in a vertex. Seeds are counted by image in a periodic domain.
using Label = std::uint64_t;
enum LabelKind : Label { of_seed = 1, of_region, of_corner, of_facet };
Label label(LabelKind kind, std::uint64_t number) {
  return Label{kind} << 56 | number;
}

/// The labels of a vertex, each once.
struct VertexLabels {
  std::vector<Label> list;
  void add(Label label) {
    if (std::find(list.begin(), list.end(), label) == list.end()) list.push_back(label);
  }
};

/// Four seeds and the four corners of a box's facet are the most that a vertex in general position has.
constexpr std::size_t labels_of_point = 8;
using PointName = std::array<Label, labels_of_point>;

struct PointNameHash {
  std::size_t operator()(const PointName& name) const {
    std::uint64_t hash = 0;
    for (const Label label : name) {
      hash = (hash ^ label) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

/// Gives vertices of the same name the same number.
class NamedPoints {
 public:
  /// \param owner  a polytope; its vertices are different points even if rounding gave them one name
  std::uint32_t add(const VertexLabels& labels, std::uint64_t owner, const double* at,
                    std::size_t dimension) {
    if (labels.list.size() > labels_of_point) return add_point(owner, at, dimension);
    PointName name{};
    std::copy(labels.list.begin(), labels.list.end(), name.begin());
    std::sort(name.begin(), name.end());
    const auto [found, is_new] = known_.try_emplace(name, 0);
    if (is_new || owner_[found->second] == owner) return found->second = add_point(owner, at, dimension);
    owner_[found->second] = owner;
    return found->second;
  }
  std::vector<double> take() { return std::move(at_); }

 private:
  std::uint32_t add_point(std::uint64_t owner, const double* at, std::size_t dimension) {
    if (owner_.size() >= std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorCode::unsupported,
                  "the cells have more than 2^32 points, which cannot be numbered; write .obj or .vtp");
    for (std::size_t k = 0; k < 3; ++k) at_.push_back(k < dimension ? at[k] : 0.0);
    owner_.push_back(owner);
    return static_cast<std::uint32_t>(owner_.size() - 1);
  }

  std::unordered_map<PointName, std::uint32_t, PointNameHash> known_;
  std::vector<double> at_;
  std::vector<std::uint64_t> owner_;  // per point: the polytope that used it last
};

/// Numbers the images of seeds: a seed as given by its own number.
class Images {
 public:
  explicit Images(std::size_t seeds) : next_(seeds) {}
  Label of(std::uint32_t seed, const std::array<std::int32_t, 3>& shift) {
    if (shift == std::array<std::int32_t, 3>{}) return label(of_seed, seed);
    const auto [found, is_new] = known_.try_emplace({seed, shift}, next_);
    if (is_new) ++next_;
    return label(of_seed, found->second);
  }

 private:
  std::uint64_t next_;
  std::map<std::pair<std::uint32_t, std::array<std::int32_t, 3>>, std::uint64_t> known_;
};

class Sharing {
 public:
  explicit Sharing(const DiagramOutput& output)
      : output_(output),
        periodic_(output.domain.is_periodic()),
        regions_(output.domain.regions()),
        images_(output.seeds.size()) {}

  SharedPoints share() {
    SharedPoints result;
    if (output_.domain.is_solid()) {
      add_joined();
    } else {
      for (std::uint32_t i = 0; i < output_.cells.cell_count(); ++i)
        for (std::uint64_t p = output_.cells.cell_offset[i]; p < output_.cells.cell_offset[i + 1]; ++p)
          add_piece(i, p);
    }
    finish(result);
    return result;
  }

 private:
  void add_piece(std::uint32_t cell, std::uint64_t piece);
  void add_face(std::uint64_t piece, std::uint64_t face, std::span<const std::uint32_t> corners);
  void add_carrier(std::uint32_t region, const std::vector<std::uint32_t>& facets,
                   VertexLabels& labels) const;
  bool has_corner(std::uint32_t facet, std::uint32_t corner, std::uint32_t corners) const;
  std::uint32_t facet_of(std::uint64_t piece, std::uint64_t face) const;
  double distance(std::uint32_t region, std::uint32_t facet, const std::array<double, 3>& from) const;
  void add_joined();
  void finish(SharedPoints& result);

  const DiagramOutput& output_;
  bool periodic_;
  RegionsView regions_;
  Images images_;
  NamedPoints points_;
  std::vector<std::uint32_t> number_;  // per vertex: a named point
  std::vector<std::uint8_t> between_;  // per vertex
  // Of the vertices of a piece:
  std::vector<VertexLabels> labels_;
  std::vector<std::vector<std::uint32_t>> facets_;
  std::vector<std::uint8_t> in_facet_;
};

bool Sharing::has_corner(std::uint32_t facet, std::uint32_t corner, std::uint32_t corners) const {
  if (regions_.shape == RegionShape::polygon) return corner == facet || corner == (facet + 1) % corners;
  if (regions_.shape == RegionShape::tetrahedron) return corner != facet;
  return (corner >> facet / 2 & 1) == (facet & 1);
}

/// Adds the corners that all these facets of a region have; the region, if there are none.
void Sharing::add_carrier(std::uint32_t region, const std::vector<std::uint32_t>& facets,
                          VertexLabels& labels) const {
  if (facets.empty()) return labels.add(label(of_region, region));
  const std::uint32_t begin = regions_.region_offset[region],
                      corners = regions_.region_offset[region + 1] - begin;
  for (std::uint32_t k = 0; k < corners; ++k)
    if (std::all_of(facets.begin(), facets.end(), [&](std::uint32_t f) { return has_corner(f, k, corners); }))
      labels.add(label(of_corner, regions_.region_vertex[begin + k]));
}

/// Of a point from an edge of a polygon.
double Sharing::distance(std::uint32_t region, std::uint32_t facet, const std::array<double, 3>& from) const {
  const std::uint32_t begin = regions_.region_offset[region],
                      corners = regions_.region_offset[region + 1] - begin;
  const auto d = static_cast<std::size_t>(regions_.dimension);
  const double* a = &regions_.vertices[d * regions_.region_vertex[begin + facet]];
  const double* b = &regions_.vertices[d * regions_.region_vertex[begin + (facet + 1) % corners]];
  double along = 0, length2 = 0;
  for (std::size_t k = 0; k < d; ++k) {
    along += (from[k] - a[k]) * (b[k] - a[k]);
    length2 += (b[k] - a[k]) * (b[k] - a[k]);
  }
  const double share = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  double sum = 0;
  for (std::size_t k = 0; k < d; ++k) {
    const double off = from[k] - a[k] - share * (b[k] - a[k]);
    sum += off * off;
  }
  return sum;
}

/// The facet of the piece's region that a face lies in. Two edges in a line may lead to the same region; then
/// the nearer one.
std::uint32_t Sharing::facet_of(std::uint64_t piece, std::uint64_t face) const {
  const Cells& cells = output_.cells;
  const std::uint32_t region = cells.region[piece], first = regions_.facet_offset[region],
                      end = regions_.facet_offset[region + 1];
  std::vector<std::uint32_t> same;
  for (std::uint32_t f = first; f < end; ++f)
    if (regions_.facet[f] == cells.border[face]) same.push_back(f - first);
  if (same.empty()) throw Error(ErrorCode::internal, "a piece has a facet that its region has not");
  if (same.size() == 1 || regions_.shape != RegionShape::polygon) return same[0];
  const auto d = static_cast<std::size_t>(cells.dimension);
  const std::uint64_t v = cells.vertex_offset[piece] + (face - cells.face_offset[piece]),
                      next = v + 1 < cells.vertex_offset[piece + 1] ? v + 1 : cells.vertex_offset[piece];
  std::array<double, 3> middle{};
  for (std::size_t k = 0; k < d; ++k)
    middle[k] = (cells.vertices[v * d + k] + cells.vertices[next * d + k]) / 2;
  return *std::min_element(same.begin(), same.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distance(region, a, middle) < distance(region, b, middle);
  });
}

void Sharing::add_face(std::uint64_t piece, std::uint64_t face, std::span<const std::uint32_t> corners) {
  const Cells& cells = output_.cells;
  const Border& border = cells.border[face];
  const bool wall = border.kind == Border::Kind::wall;
  if (wall || periodic_) {
    const Label name = wall ? images_.of(border.index, periodic_ ? cells.shift[face] : std::array<int, 3>{})
                            : label(of_facet, border.index);
    for (const std::uint32_t v : corners) labels_[v].add(name);
    return;
  }
  const std::uint32_t facet = facet_of(piece, face);
  for (const std::uint32_t v : corners) {
    facets_[v].push_back(facet);
    if (border.kind == Border::Kind::interior) in_facet_[v] = 1;
  }
}

void Sharing::add_piece(std::uint32_t cell, std::uint64_t piece) {
  const Cells& cells = output_.cells;
  const auto d = static_cast<std::size_t>(cells.dimension);
  const std::uint64_t first = cells.vertex_offset[piece];
  const auto count = static_cast<std::uint32_t>(cells.vertex_offset[piece + 1] - first);
  const std::uint32_t seed = output_.rows ? output_.rows->seed[cell] : cell;
  labels_.resize(std::max<std::size_t>(labels_.size(), count));
  facets_.resize(labels_.size());
  for (std::uint32_t v = 0; v < count; ++v) {
    labels_[v].list.assign(1, label(of_seed, seed));
    facets_[v].clear();
  }
  in_facet_.assign(count, 0);
  for (std::uint64_t f = cells.face_offset[piece]; f < cells.face_offset[piece + 1]; ++f) {
    if (cells.cell_dimension == 3) {
      add_face(piece, f,
               std::span(cells.loop)
                   .subspan(cells.loop_offset[f], cells.loop_offset[f + 1] - cells.loop_offset[f]));
    } else {
      const auto v = static_cast<std::uint32_t>(f - cells.face_offset[piece]);
      add_face(piece, f, std::array{v, (v + 1) % count});
    }
  }
  for (std::uint32_t v = 0; v < count; ++v) {
    if (!periodic_) add_carrier(cells.region[piece], facets_[v], labels_[v]);
    number_.push_back(points_.add(labels_[v], piece, &cells.vertices[(first + v) * d], d));
    between_.push_back(in_facet_[v]);
  }
}

void Sharing::add_joined() {
  const JoinedCells& joined = output_.joined;
  for (std::uint32_t i = 0; i + 1 < joined.face_offset.size(); ++i) {
    const std::uint64_t first = joined.vertex_offset[i], count = joined.vertex_offset[i + 1] - first;
    labels_.resize(std::max<std::size_t>(labels_.size(), count));
    for (std::uint64_t v = 0; v < count; ++v) labels_[v].list.assign(1, label(of_seed, i));
    for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f) {
      const Border& border = joined.face_border[f];
      const Label name = label(border.kind == Border::Kind::wall ? of_seed : of_facet, border.index);
      for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e)
        labels_[joined.loop[e]].add(name);
    }
    for (std::uint64_t v = 0; v < count; ++v) {
      number_.push_back(points_.add(labels_[v], i, &joined.vertices[3 * (first + v)], 3));
      between_.push_back(0);
    }
  }
}

/// The groups of points that are only rounding apart.
Groups near_points(const std::vector<double>& at) {
  const std::size_t count = at.size() / 3;
  Groups groups(count);
  double largest = 0;
  for (const double x : at) largest = std::max(largest, std::fabs(x));
  const double within = 0x1p-44 * largest;
  // Points are sorted along a direction in which those of a lattice do not fall together.
  const auto along = [&](std::size_t p) {
    return at[3 * p] + 0.618033988749895 * at[3 * p + 1] + 0.414213562373095 * at[3 * p + 2];
  };
  std::vector<std::pair<double, std::uint32_t>> order(count);
  for (std::size_t p = 0; p < count; ++p) order[p] = {along(p), static_cast<std::uint32_t>(p)};
  std::sort(order.begin(), order.end());
  const double window = 1.5 * within;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count && order[b].first <= order[a].first + window; ++b) {
      const double *x = &at[3 * std::size_t{order[a].second}], *y = &at[3 * std::size_t{order[b].second}];
      if (std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]) <= within)
        groups.unite(order[a].second, order[b].second);
    }
  return groups;
}

void Sharing::finish(SharedPoints& result) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  const std::vector<double> at = points_.take();
  Groups groups = near_points(at);
  std::vector<std::uint32_t> of_group(at.size() / 3, none);
  result.number = std::move(number_);
  for (std::size_t v = 0; v < result.number.size(); ++v) {
    const std::uint32_t group = groups.of(result.number[v]);
    if (of_group[group] == none) {
      of_group[group] = static_cast<std::uint32_t>(result.size());
      result.at.insert(result.at.end(), &at[3 * std::size_t{group}], &at[3 * std::size_t{group}] + 3);
      result.between.push_back(0);
    }
    result.number[v] = of_group[group];
    if (between_[v]) result.between[result.number[v]] = 1;
  }
}

}  // namespace

SharedPoints share_points(const DiagramOutput& output) {
  return Sharing(output).share();
}

}  // namespace powercell::io
