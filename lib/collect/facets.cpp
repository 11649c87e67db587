#include "lib/collect/facets.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "kernels/layout.h"
#include "lib/base/vectors.hpp"

namespace powercell {

void FacetCollector::add(std::span<const std::uint32_t> pair_row, std::span<const std::uint32_t> pair_region,
                         const PieceSet& pieces) {
  for (std::size_t k = 0; k < pair_row.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE) continue;  // one without thickness has its facets on both sides
    const PieceBatch& batch = pieces.batches[pieces.batch[k]];
    const std::uint32_t row = pieces.row[k], first = mesh_.facet_offset[pair_region[k]];
    for (std::uint32_t f = 0; f < batch.faces(row); ++f) {
      const std::int32_t code = batch.borders(row)[f];
      if (code >= 0) continue;
      const Border& border = mesh_.facet[first + static_cast<std::uint32_t>(~code)];
      if (border.kind == Border::Kind::boundary)
        parts_.push_back({pair_row[k], border.index, batch.walls(row)[f]});
    }
  }
}

BoundaryWalls FacetCollector::finish(std::span<const std::uint32_t> place,
                                     const std::vector<SeedStatus>& status, double unit) {
  std::erase_if(parts_, [&](const Part& part) { return status[place[part.row]] != SeedStatus::ok; });
  const auto key = [&](const Part& part) { return std::pair(place[part.row], part.facet); };
  // Stable, so that the sums below are in the order of the pairs.
  std::stable_sort(parts_.begin(), parts_.end(),
                   [&](const Part& a, const Part& b) { return key(a) < key(b); });
  BoundaryWalls out;
  out.offset.assign(status.size() + 1, 0);
  for (std::size_t k = 0; k < parts_.size();) {
    const Part& part = parts_[k];
    double measure = 0;
    for (; k < parts_.size() && key(parts_[k]) == key(part); ++k) measure += parts_[k].measure;
    if (!(measure > 0)) continue;
    ++out.offset[place[part.row] + std::size_t{1}];
    out.facet.push_back(part.facet);
    out.measure.push_back(measure * unit);
  }
  std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
  return out;
}

namespace {

/// The area of face f of cell i, a convex polygon.
double area_of(const JoinedCells& cells, std::size_t i, std::uint64_t f) {
  const auto corner = [&](std::uint64_t k) {
    const double* x = &cells.vertices[3 * (cells.vertex_offset[i] + cells.loop[k])];
    return Vector3<double>{x[0], x[1], x[2]};
  };
  Vector3<double> twice{};
  const Vector3<double> first = corner(cells.loop_offset[f]);
  for (std::uint64_t k = cells.loop_offset[f] + 2; k < cells.loop_offset[f + 1]; ++k)
    twice = twice + cross(corner(k - 1) - first, corner(k) - first);
  return norm(twice) / 2;
}

}  // namespace

BoundaryWalls facets_of(const JoinedCells& cells) {
  BoundaryWalls out;
  out.offset.push_back(0);
  for (std::size_t i = 0; i + 1 < cells.face_offset.size(); ++i) {
    std::map<std::uint32_t, double> area;
    for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f)
      if (cells.face_border[f].kind == Border::Kind::boundary)
        area[cells.face_border[f].index] += area_of(cells, i, f);
    for (const auto& [facet, measure] : area) {
      if (!(measure > 0)) continue;
      out.facet.push_back(facet);
      out.measure.push_back(measure);
    }
    out.offset.push_back(out.facet.size());
  }
  return out;
}

}  // namespace powercell
