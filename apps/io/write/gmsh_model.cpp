#include "apps/io/write/gmsh_model.hpp"

#include <algorithm>
#include <powercell/regions.hpp>
#include <tuple>
#include <utility>

#include "apps/io/write/shared_cells.hpp"
#include "apps/io/write/shared_points.hpp"
#include "apps/io/write/wall_triangles.hpp"

namespace powercell::io {
namespace {

/// Whether the facets of the domain are sides that a user knows, not elements of a mesh.
bool has_sides(const Domain& domain) {
  if (domain.kind() == DomainKind::polygon) return true;
  return domain.kind() == DomainKind::volume && !domain.is_solid() &&
         domain.regions().shape == RegionShape::box;
}

/// The physical groups of walls and boundary, in the dimension below that of cells: 1 the walls, 2 and so on
/// the boundary.
class WallGroups {
 public:
  WallGroups(const Domain& domain, std::map<std::uint64_t, std::string>& names)
      : sides_(has_sides(domain)), names_(names) {}
  std::uint64_t of(const Border& border) {
    if (border.kind == Border::Kind::wall) {
      names_.try_emplace(1, "walls");
      return 1;
    }
    const std::uint64_t tag = sides_ ? 2 + std::uint64_t{border.index} : 2;
    names_.try_emplace(tag, sides_ ? "facet_" + std::to_string(border.index) : "boundary");
    return tag;
  }

 private:
  bool sides_;
  std::map<std::uint64_t, std::string>& names_;
};

void add_cell(GmshModel& model, std::size_t dimension, std::uint32_t seed, GmshEntity entity) {
  entity.tag = entity.group = std::uint64_t{seed} + 1;
  model.groups[dimension][entity.group] = "cell_" + std::to_string(seed);
  model.entities[dimension].push_back(std::move(entity));
}

std::int64_t signed_tag(std::uint64_t tag, bool negative) {
  const auto value = static_cast<std::int64_t>(tag);
  return negative ? -value : value;
}

/// Edges of walls have a group because meshio takes either all elements or none to have one.
constexpr std::uint64_t edge_group = 1;

class VolumeModel {
 public:
  VolumeModel(const std::string& path, const DiagramOutput& output)
      : path_(path), cells_(fitting_cells(path, output)), groups_(output.domain, model_.groups[2]) {}

  GmshModel make() {
    for (std::uint32_t p = 0; p < cells_.point_count(); ++p)
      model_.entities[0].push_back({std::uint64_t{p} + 1, 0, {}, {p}, {}});
    surface_.assign(cells_.face_count(), 0);
    for (std::uint32_t i = 0; i < cells_.cell_count(); ++i) {
      GmshEntity volume;
      for (std::uint64_t f = cells_.face_offset[i]; f < cells_.face_offset[i + 1]; ++f) {
        const bool behind = cells_.twin[f] < f;
        if (!behind) add_surface(f);
        volume.bounds.push_back(signed_tag(surface_[std::min(f, cells_.twin[f])], behind));
      }
      if (!volume.bounds.empty()) add_cell(model_, 3, i, std::move(volume));
    }
    if (!model_.entities[1].empty()) model_.groups[1][edge_group] = "edges";
    model_.points = std::move(cells_.points);
    return std::move(model_);
  }

 private:
  std::uint64_t curve(std::uint32_t a, std::uint32_t b) {
    auto& curves = model_.entities[1];
    const auto [found, is_new] = curve_.try_emplace(std::minmax(a, b), curves.size() + 1);
    if (is_new) {
      const auto [low, high] = found->first;
      curves.push_back({found->second,
                        edge_group,
                        {signed_tag(low + 1U, false), signed_tag(high + 1U, true)},
                        {},
                        {low, high}});
    }
    return found->second;
  }

  void add_surface(std::uint64_t f) {
    auto& surfaces = model_.entities[2];
    GmshEntity surface{
        surfaces.size() + 1, groups_.of(cells_.face_border[f]), {}, {}, triangles_of(path_, cells_, f)};
    const auto loop = cells_.face(f);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t from = loop[k], to = loop[(k + 1) % loop.size()];
      surface.bounds.push_back(signed_tag(curve(from, to), from > to));
    }
    surface_[f] = surface.tag;
    surfaces.push_back(std::move(surface));
  }

  const std::string& path_;
  GmshModel model_;
  SharedCells cells_;
  WallGroups groups_;
  std::vector<std::uint64_t> surface_;  // per face: its tag
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> curve_;
};

/// Polygons and surfaces, from the convex pieces of the cells, which share their points.
class FlatModel {
 public:
  FlatModel(const std::string& path, const DiagramOutput& output)
      : path_(path), output_(output), groups_(output.domain, model_.groups[1]) {
    fitting_cells(path, output);
    points_ = share_points(output);
  }

  GmshModel make() {
    for (std::uint32_t i = 0; i < output_.cells.cell_count(); ++i) add_pieces(i);
    for (auto& [key, curve] : curves_) model_.entities[1].push_back(std::move(curve));
    std::sort(model_.entities[1].begin(), model_.entities[1].end(),
              [](const GmshEntity& a, const GmshEntity& b) { return a.tag < b.tag; });
    classify_nodes();
    model_.points = std::move(points_.at);
    return std::move(model_);
  }

 private:
  /// The wall of cell i at an edge of a piece, as seen from the lower seed within the domain.
  using Key = std::tuple<std::uint32_t, Border::Kind, std::uint32_t, std::array<std::int32_t, 3>>;
  Key key_of(std::uint32_t i, std::uint64_t face) const {
    const Border& border = output_.cells.border[face];
    const std::array<std::int32_t, 3> shift =
        output_.cells.shift.empty() ? std::array<std::int32_t, 3>{} : output_.cells.shift[face];
    if (border.kind == Border::Kind::wall && shift == std::array<std::int32_t, 3>{} && border.index < i)
      return {border.index, border.kind, i, shift};
    return {i, border.kind, border.index, shift};
  }

  void add_pieces(std::uint32_t i) {
    const Cells& cells = output_.cells;
    GmshEntity surface;
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      std::vector<std::uint32_t> loop;
      const std::uint64_t first = cells.vertex_offset[p], n = cells.vertex_offset[p + 1] - first;
      for (std::uint64_t k = 0; k < n; ++k) {
        const std::uint32_t a = points_.number[first + k], b = points_.number[first + (k + 1) % n];
        if (a == b) continue;
        loop.push_back(a);
        const std::uint64_t face = cells.face_offset[p] + k;
        if (cells.border[face].kind != Border::Kind::interior) add_line(key_of(i, face), i, a, b, surface);
      }
      if (loop.size() < 3) continue;
      const std::vector<std::uint32_t> triangles = triangles_of(path_, points_.at, std::move(loop));
      surface.elements.insert(surface.elements.end(), triangles.begin(), triangles.end());
    }
    if (!surface.elements.empty()) add_cell(model_, 2, i, std::move(surface));
  }

  void add_line(const Key& key, std::uint32_t i, std::uint32_t a, std::uint32_t b, GmshEntity& surface) {
    const auto [found, is_new] = curves_.try_emplace(key);
    GmshEntity& curve = found->second;
    if (is_new) {
      curve.tag = curves_.size();
      curve.group = groups_.of({std::get<1>(key), std::get<2>(key)});
    }
    const bool own = std::get<0>(key) == i;
    if (own) curve.elements.insert(curve.elements.end(), {a, b});
    const std::int64_t tag = signed_tag(curve.tag, !own);
    if (std::find(surface.bounds.begin(), surface.bounds.end(), tag) == surface.bounds.end())
      surface.bounds.push_back(tag);
  }

  /// A node belongs to the first curve that it lies in, else to its surface.
  void classify_nodes() {
    std::vector<std::uint8_t> done(points_.size());
    for (const std::size_t dimension : {1, 2})
      for (GmshEntity& entity : model_.entities[dimension])
        for (const std::uint32_t p : entity.elements)
          if (!std::exchange(done[p], 1)) entity.nodes.push_back(p);
  }

  const std::string& path_;
  const DiagramOutput& output_;
  GmshModel model_;
  WallGroups groups_;
  SharedPoints points_;
  std::map<Key, GmshEntity> curves_;
};

}  // namespace

GmshModel gmsh_model(const std::string& path, const DiagramOutput& output) {
  if (output.domain.cell_dimension() == 3) return VolumeModel(path, output).make();
  return FlatModel(path, output).make();
}

}  // namespace powercell::io
