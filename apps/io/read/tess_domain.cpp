#include <fmt/format.h>

#include <algorithm>
#include <powercell/error.hpp>
#include <powercell/regions.hpp>
#include <set>

#include "apps/io/write/tess.hpp"

namespace powercell::io {
namespace {

using Facets = std::vector<std::uint32_t>;  // ascending

/// Facets, edges and vertices of a domain are found from what lies in them: an edge of a volume where two
/// facets meet, a vertex where three meet; in the plane a vertex where two edges meet.
class Finder {
 public:
  Finder(const std::string& path, const DiagramOutput& output, const Tess& tess)
      : path_(path), output_(output), tess_(tess), cells_(tess.cells), volume_(cells_.cell_dimension == 3) {
    domain_.box = is_box();
  }

  TessDomain find() {
    if (volume_)
      add_faces();
    else
      add_boundary_edges();
    add_vertices();
    end_edges();
    if (volume_) order_faces();
    return std::move(domain_);
  }

 private:
  void add_faces();
  void add_boundary_edges();
  void add_vertices();
  void end_edges();
  void order_faces();
  void order_face(std::uint32_t f);
  std::string label_of(const Facets& facets) const;
  [[noreturn]] void refuse(std::uint32_t facet) const {
    throw Error(
        ErrorCode::write_failed,
        fmt::format("{}: facet {} of the domain is not a polygon between straight edges, as .tess needs it; "
                    "write .vtu or .msh",
                    path_, facet));
  }
  bool is_box() const {
    const RegionsView regions = output_.domain.regions();
    if (output_.domain.is_solid() || regions.size() != 1) return false;
    if (volume_) return regions.shape == RegionShape::box;
    // The edges of a box in the plane begin at its lower left corner, along x.
    const auto low = output_.domain.low(), high = output_.domain.high();
    const double corners[8] = {low[0], low[1], high[0], low[1], high[0], high[1], low[0], high[1]};
    if (regions.region_vertex.size() != 4) return false;
    for (std::size_t k = 0; k < 8; ++k)
      if (regions.vertices[2 * regions.region_vertex[k / 2] + k % 2] != corners[k]) return false;
    return true;
  }

  const std::string& path_;
  const DiagramOutput& output_;
  const Tess& tess_;
  const SharedCells& cells_;
  bool volume_;
  std::map<std::uint32_t, std::uint32_t> facet_number_;   // volume: facet → face of the domain
  std::map<std::uint32_t, Facets> at_edge_;               // edge of the tessellation → facets
  std::map<Facets, std::uint32_t> edge_number_;           // facets → edge of the domain
  std::vector<Facets> facets_of_edge_;                    // edge of the domain → facets
  std::map<std::uint32_t, std::uint32_t> vertex_number_;  // point → vertex of the domain
  TessDomain domain_;
};

void add(Facets& facets, std::uint32_t facet) {
  const auto place = std::lower_bound(facets.begin(), facets.end(), facet);
  if (place == facets.end() || *place != facet) facets.insert(place, facet);
}

/// Neper's names: x0, x1, y0 and so on for the sides of a box, f1, f2 and so on for others (in the plane e1,
/// e2).
std::string Finder::label_of(const Facets& facets) const {
  static constexpr std::array<const char*, 6> in_space = {"x0", "x1", "y0", "y1", "z0", "z1"};
  static constexpr std::array<const char*, 4> in_plane = {"y0", "x1", "y1", "x0"};
  std::vector<std::string> parts;
  const bool box = domain_.box;
  for (const std::uint32_t f : facets)
    parts.push_back(box ? (volume_ ? in_space.at(f) : in_plane.at(f))
                        : fmt::format("{}{}", volume_ ? "f" : "e", f + 1));
  if (box) std::sort(parts.begin(), parts.end());
  std::string label;
  for (const std::string& part : parts) label += part;
  return label;
}

void Finder::add_faces() {
  for (std::uint32_t k = 0; k < tess_.face.size(); ++k) {
    const std::uint64_t f = tess_.face[k];
    const Border& border = cells_.face_border[f];
    if (border.kind != Border::Kind::boundary) continue;
    const auto [found, is_new] =
        facet_number_.try_emplace(border.index, static_cast<std::uint32_t>(domain_.faces.size()));
    if (is_new) {
      TessDomainFace face;
      face.plane = plane_of(cells_, cells_.face(f));
      for (double& x : face.plane) x = -x;
      face.label = label_of({border.index});
      domain_.faces.push_back(std::move(face));
    }
    domain_.faces[found->second].faces.push_back(k);
    const auto loop = cells_.face(f);
    for (std::size_t e = 0; e < loop.size(); ++e)
      add(at_edge_[tess_.edge_number.at(std::minmax(loop[e], loop[(e + 1) % loop.size()]))], border.index);
  }
  std::erase_if(at_edge_, [](const auto& edge) { return edge.second.size() < 2; });
}

void Finder::add_boundary_edges() {
  for (const std::uint64_t f : tess_.face) {
    const auto loop = cells_.face(f);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Border& border = cells_.edge_border[cells_.loop_offset[f] + k];
      if (border.kind == Border::Kind::boundary)
        add(at_edge_[tess_.edge_number.at(std::minmax(loop[k], loop[(k + 1) % loop.size()]))], border.index);
    }
  }
}

void Finder::add_vertices() {
  std::map<std::uint32_t, Facets> at_point;
  for (const auto& [edge, facets] : at_edge_) {
    const auto [found, is_new] =
        edge_number_.try_emplace(facets, static_cast<std::uint32_t>(domain_.edges.size()));
    if (is_new) {
      domain_.edges.push_back({{}, {}, label_of(facets)});
      facets_of_edge_.push_back(facets);
    }
    domain_.edges[found->second].edges.push_back(edge);
    for (const std::uint32_t p : {tess_.edges[edge].first, tess_.edges[edge].second})
      for (const std::uint32_t f : facets) add(at_point[p], f);
  }
  const std::size_t least = volume_ ? 3 : 2;
  for (const auto& [point, facets] : at_point) {
    if (facets.size() < least) continue;
    vertex_number_[point] = static_cast<std::uint32_t>(domain_.vertices.size());
    domain_.vertices.push_back(
        {point, domain_.box ? label_of(facets) : fmt::format("v{}", domain_.vertices.size() + 1)});
  }
}

void Finder::end_edges() {
  for (std::size_t e = 0; e < domain_.edges.size(); ++e) {
    std::set<std::uint32_t> ends;
    for (const std::uint32_t edge : domain_.edges[e].edges)
      for (const std::uint32_t p : {tess_.edges[edge].first, tess_.edges[edge].second})
        if (const auto found = vertex_number_.find(p); found != vertex_number_.end())
          ends.insert(found->second);
    if (ends.size() != 2) refuse(facets_of_edge_[e][0]);
    domain_.edges[e].vertices.assign(ends.begin(), ends.end());
  }
}

/// Walks around a facet.
void Finder::order_face(std::uint32_t facet) {
  TessDomainFace& face = domain_.faces[facet_number_.at(facet)];
  std::map<std::uint32_t, std::vector<std::uint32_t>> at_vertex;
  std::size_t count = 0;
  for (std::uint32_t e = 0; e < domain_.edges.size(); ++e) {
    if (!std::binary_search(facets_of_edge_[e].begin(), facets_of_edge_[e].end(), facet)) continue;
    ++count;
    for (const std::uint32_t v : domain_.edges[e].vertices) at_vertex[v].push_back(e);
  }
  for (const auto& [vertex, edges] : at_vertex)
    if (edges.size() != 2) refuse(facet);
  if (count < 3) refuse(facet);
  std::uint32_t vertex = at_vertex.begin()->first, edge = at_vertex.begin()->second[0];
  do {
    face.vertices.push_back(vertex);
    face.edges.push_back(edge);
    const auto& ends = domain_.edges[edge].vertices;
    vertex = ends[0] == vertex ? ends[1] : ends[0];
    const auto& next = at_vertex.at(vertex);
    edge = next[0] == edge ? next[1] : next[0];
  } while (vertex != at_vertex.begin()->first);
  if (face.edges.size() != count) refuse(facet);
}

void Finder::order_faces() {
  for (const auto& [facet, number] : facet_number_) order_face(facet);
}

}  // namespace

TessDomain domain_of(const std::string& path, const DiagramOutput& output, const Tess& tess) {
  return Finder(path, output, tess).find();
}

}  // namespace powercell::io
