// Diagrams without their domain: walls, pieces and the domain's box are derived from the vertices of the
// cells.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "lib/base/float_environment.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

[[noreturn]] void refuse_saved(const std::string& what) {
  throw Error(ErrorCode::invalid_argument, what);
}

bool is_offset(const std::vector<std::uint64_t>& offset, std::size_t count, std::size_t end) {
  return offset.size() == count + 1 && offset.front() == 0 && std::ranges::is_sorted(offset) &&
         offset.back() == end;
}

void require_fit(const SavedDiagram& saved) {
  const JoinedCells& cells = saved.cells;
  const std::size_t n = saved.seeds.size(),
                    faces = cells.loop_offset.empty() ? 0 : cells.loop_offset.size() - 1;
  const auto d = static_cast<std::size_t>(saved.kind == DomainKind::polygon ? 2 : 3);
  const bool volume = saved.kind == DomainKind::volume;
  if (saved.seeds.dimension != static_cast<int>(d) || saved.seeds.positions.size() != n * d ||
      (!saved.seeds.weights.empty() && saved.seeds.weights.size() != n))
    refuse_saved("the seeds have not the dimension of the domain, or not all coordinates or weights");
  if (saved.measures.dimension != static_cast<int>(d) || saved.measures.mass.size() != n ||
      saved.measures.status.size() != n ||
      (!saved.measures.centroid.empty() && saved.measures.centroid.size() != n * d))
    refuse_saved("the measures are not those of " + std::to_string(n) + " seeds");
  if (cells.dimension != static_cast<int>(d) || cells.cell_dimension != (volume ? 3 : 2) ||
      !is_offset(cells.vertex_offset, n, cells.vertices.size() / d) ||
      !is_offset(cells.face_offset, n, faces) || !is_offset(cells.loop_offset, faces, cells.loop.size()) ||
      (volume ? cells.face_border.size() != faces : cells.edge_border.size() != cells.loop.size()))
    refuse_saved("the arrays of the cells differ in length");
  if (!cells.shift.empty())
    throw Error(ErrorCode::unsupported,
                "the cells are those of a periodic domain, whose periods are not saved with them; check the "
                "diagram itself (verify(Diagram&))");
  const std::vector<Border>& border = volume ? cells.face_border : cells.edge_border;
  for (std::size_t i = 0; i < n; ++i)
    for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f) {
      const std::uint64_t begin = cells.loop_offset[f], end = cells.loop_offset[f + 1];
      const auto name = [&] {
        return "face " + std::to_string(f - cells.face_offset[i]) + " of cell " + std::to_string(i);
      };
      if (end - begin < 3) refuse_saved(name() + " has fewer than 3 corners");
      for (std::uint64_t e = begin; e < end; ++e)
        if (cells.loop[e] >= cells.vertex_offset[i + 1] - cells.vertex_offset[i])
          refuse_saved(name() + " has a corner that is not a vertex of the cell");
      for (std::uint64_t b = volume ? f : begin; b < (volume ? f + 1 : end); ++b)
        if (border[b].kind == Border::Kind::wall && border[b].index >= n)
          refuse_saved(name() + " borders on a seed that does not exist");
    }
}

}  // namespace

Cells pieces_of(const JoinedCells& joined, const std::vector<SeedStatus>& status) {
  const auto d = static_cast<std::size_t>(joined.dimension);
  const bool volume = joined.cell_dimension == 3;
  Cells cells;
  cells.dimension = joined.dimension;
  cells.cell_dimension = joined.cell_dimension;
  cells.cell_offset = cells.vertex_offset = cells.face_offset = {0};
  if (volume) {
    cells.border = joined.face_border;
    cells.loop_offset = joined.loop_offset;
    cells.loop = joined.loop;
  } else {
    cells.border = joined.edge_border;
  }
  const auto add_vertex = [&](std::uint64_t v) {
    cells.vertices.insert(cells.vertices.end(), &joined.vertices[v * d], &joined.vertices[v * d] + d);
  };
  const auto end_piece = [&](std::uint64_t faces) {
    cells.region.push_back(0);
    cells.vertex_offset.push_back(cells.vertices.size() / d);
    cells.face_offset.push_back(faces);
  };
  for (std::size_t i = 0; i + 1 < joined.face_offset.size(); ++i) {
    const std::uint64_t first = joined.face_offset[i], end = joined.face_offset[i + 1];
    if (volume && first < end) {
      for (std::uint64_t v = joined.vertex_offset[i]; v < joined.vertex_offset[i + 1]; ++v) add_vertex(v);
      end_piece(end);
    }
    for (std::uint64_t f = first; !volume && f < end; ++f) {
      for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e)
        add_vertex(joined.vertex_offset[i] + joined.loop[e]);
      end_piece(joined.loop_offset[f + 1]);
    }
    if (first == end && status[i] == SeedStatus::ok) end_piece(cells.face_offset.back());
    cells.cell_offset.push_back(cells.region.size());
  }
  return cells;
}

namespace {

Extent extent_of(const Cells& cells, double measure) {
  Extent extent{cells.cell_dimension, {}, {}, measure};
  const auto d = static_cast<std::size_t>(cells.dimension);
  for (std::size_t k = 0; k < cells.vertices.size(); ++k) {
    double &low = extent.low[k % d], &high = extent.high[k % d];
    low = k < d ? cells.vertices[k] : std::min(low, cells.vertices[k]);
    high = k < d ? cells.vertices[k] : std::max(high, cells.vertices[k]);
  }
  return extent;
}

/// A wall as seen from one side.
struct Side {
  long double measure = 0;
  long double rim = 0;  // largest change of the measure if the vertices move by 1
};

std::map<std::pair<std::uint32_t, std::uint32_t>, Side> sides_of(const Cells& cells) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Side> sides;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
      for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
        if (cells.border[f].kind != Border::Kind::wall) continue;
        const std::vector<Vector> corners = face_corners(cells, p, f);
        Side& side = sides[{i, cells.border[f].index}];
        side.measure += face_measure(corners);
        for (std::size_t k = 0; k < corners.size(); ++k)
          side.rim += corners.size() == 2 ? 1 : norm(corners[(k + 1) % corners.size()] - corners[k]);
      }
  return sides;
}

/// Walls with both sides averaged. Differences within the rounding of the coordinates do not count.
Adjacency adjacency_of(const Cells& cells, const Rounding& rounding) {
  auto sides = sides_of(cells);
  for (const auto& [seeds, side] : std::map(sides)) sides.try_emplace({seeds.second, seeds.first});
  Adjacency adjacency;
  adjacency.offset.assign(cells.cell_count() + 1, 0);
  for (const auto& [seeds, here] : sides) {
    const Side& there = sides.at({seeds.second, seeds.first});
    const auto difference = static_cast<double>(std::fabs(here.measure - there.measure) -
                                                rounding.coordinate() * (here.rim + there.rim));
    if (difference > adjacency.asymmetry || std::isnan(difference)) {
      adjacency.asymmetry = difference;
      adjacency.asymmetric = {seeds.first, seeds.second};
    }
    ++adjacency.offset[seeds.first + 1];
    adjacency.neighbor.push_back(seeds.second);
    adjacency.wall.push_back(static_cast<double>((here.measure + there.measure) / 2));
  }
  for (std::size_t i = 0; i < cells.cell_count(); ++i) adjacency.offset[i + 1] += adjacency.offset[i];
  return adjacency;
}

}  // namespace

std::vector<LawCheck> verify(const SavedDiagram& diagram, const VerifyOptions& options) {
  const FloatEnvironment environment;
  require_fit(diagram);
  const Cells cells = pieces_of(diagram.cells, diagram.measures.status);
  const Rounding rounding(extent_of(cells, diagram.measures.domain_measure), diagram.seeds,
                          diagram.precision);
  std::vector<LawCheck> checks{check_partition(diagram.measures, cells, nullptr, rounding),
                               check_statuses(diagram.measures, cells, diagram.seeds),
                               check_walls(adjacency_of(cells, rounding), nullptr, rounding)};
  for (LawCheck& check : check_pieces(diagram.measures, cells, rounding)) checks.push_back(std::move(check));
  checks.push_back(check_bisectors(cells, rounding));
  checks.push_back(check_vertices(cells, rounding, options));
  return checks;
}

}  // namespace powercell
