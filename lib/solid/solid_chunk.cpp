#include "lib/solid/solid_chunk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernels/layout.h"
#include "lib/base/compiler.hpp"
#include "lib/base/threads.hpp"
#include "lib/cell/exact_planes.hpp"
#include "lib/domain/outline.hpp"

namespace powercell::solid {
namespace {

constexpr std::size_t cells_of_task = 64;
/// Half the edge of the cube that a cell is clipped in, relative to its farthest point on the boundary.
/// Nearly all cells end within it, and in a smaller cube fewer seeds are tried.
constexpr double cube_size = 1.2;
/// Distance of the container from the domain, as a part of its extent.
constexpr double container_margin = 1.0 / 16;

WholeCell whole_cell(const PieceSet& pieces, std::size_t pair) {
  const PieceBatch& batch = pieces.batches[pieces.batch[pair]];
  const std::uint32_t row = pieces.row[pair], face = batch.face_offset[row], faces = batch.faces(row),
                      vertex = batch.vertex_offset[row], vertices = batch.vertices(row);
  return {std::span(batch.border).subspan(face, faces), std::span(batch.wall).subspan(face, faces),
          std::span(batch.vertex).subspan(3 * std::size_t{vertex}, 3 * std::size_t{vertices}),
          std::span(batch.link).subspan(6 * std::size_t{vertex}, 6 * std::size_t{vertices})};
}

std::span<const double> vertices_of(const PieceSet& pieces, std::size_t pair) {
  const PieceBatch& batch = pieces.batches[pieces.batch[pair]];
  const std::uint32_t row = pieces.row[pair];
  return std::span(batch.vertex)
      .subspan(3 * std::size_t{batch.vertex_offset[row]}, 3 * std::size_t{batch.vertices(row)});
}

std::span<const std::int32_t> borders_of(const PieceSet& pieces, std::size_t pair) {
  const PieceBatch& batch = pieces.batches[pieces.batch[pair]];
  const std::uint32_t row = pieces.row[pair];
  return std::span(batch.border).subspan(batch.face_offset[row], batch.vertices(row));
}

/// The borders of a whole triangle.
constexpr std::array<std::int32_t, 3> whole_border{~0, ~1, ~2};

}  // namespace

Chunk::Chunk(const SolidCellsInput& input, const std::vector<bool>& alone,
             std::span<const std::uint32_t> ranks)
    : input_(input), alone_(alone), ranks_(ranks), has_tetrahedra_(!input.domain.solid_boundary) {
  const RegionMesh& mesh = input.boundary.mesh;
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k)
    reach = std::max({reach, std::fabs(mesh.low[k]), std::fabs(mesh.high[k])});
  rounding_ = 4 * std::numeric_limits<double>::epsilon() * reach * input.scene.frame().scale;
}

void Chunk::clip_facets(Clipper& clipper) {
  const Pairs& pairs = input_.pairs;
  std::vector<std::uint32_t> seed, region;
  for (const std::uint32_t rank : ranks_)
    for (std::uint64_t p = pairs.offset[rank]; p < pairs.offset[rank + 1]; ++p)
      if (!alone_[pairs.region[p]]) {
        seed.push_back(rank);
        region.push_back(pairs.region[p]);
      }
  clipped_ = &clipper.clip(seed, region);
  find_touched();
  if (!has_tetrahedra_ && !clipped_->tied.empty())
    host_scene_ = make_host_scene(
        {input_.boundary.on_device, input_.scene.buffers, input_.scene.seeds, input_.scene.tree});
}

std::array<double, 9> Chunk::corners_of(std::uint32_t triangle, std::uint32_t rank) const {
  const RegionMesh& mesh = input_.boundary.mesh;
  const double* const seed = &input_.scene.seeds.positions[3 * std::size_t{rank}];
  const double scale = input_.scene.frame().scale;
  std::array<double, 9> x;
  for (std::size_t k = 0; k < 9; ++k) {
    const std::size_t corner = mesh.region_vertex[3 * std::size_t{triangle} + k / 3];
    x[k] = scale * mesh.vertices[3 * corner + k % 3] - scale * seed[k % 3];
  }
  return x;
}

void Chunk::find_touched() {
  const Pairs& pairs = input_.pairs;
  const std::vector<std::uint32_t>& tied = clipped_->tied;
  std::uint32_t pair = 0;
  for (const std::uint32_t rank : ranks_) {
    const std::size_t first = piece_.size();
    const std::uint32_t first_pair = pair;
    double square = -1;
    const auto add = [&](Piece piece, std::span<const double> x) {
      piece_.push_back(piece);
      for (std::size_t v = 0; v < x.size(); v += 3)
        square = std::max(square, x[v] * x[v] + x[v + 1] * x[v + 1] + x[v + 2] * x[v + 2]);
    };
    for (std::uint64_t p = pairs.offset[rank]; p < pairs.offset[rank + 1]; ++p) {
      const std::uint32_t triangle = pairs.region[p];
      if (alone_[triangle]) {
        add({triangle, whole}, corners_of(triangle, rank));
        continue;
      }
      if (clipped_->status[pair] != PIECE_EMPTY) add({triangle, pair}, vertices_of(*clipped_, pair));
      ++pair;
    }
    const auto tie = std::lower_bound(tied.begin(), tied.end(), first_pair);
    const bool is_tied = tie != tied.end() && *tie < pair;
    if (square >= 0)
      touched_.push_back({rank, first, piece_.size(), is_tied, std::sqrt(square)});
    else if (is_tied && has_tetrahedra_)
      tied_alone_.push_back(rank);  // a triangle in one of its walls belongs to the cell behind
  }
  outcome_.resize(touched_.size());
}

std::vector<double> Chunk::boxes() const {
  const RegionMesh& domain = input_.domain;
  std::vector<double> corners;
  std::array<double, 3> low{}, high{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double margin = container_margin * (domain.high[k] - domain.low[k]);
    low[k] = domain.low[k] - margin;
    high[k] = domain.high[k] + margin;
  }
  const auto add = [&](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    corners.insert(corners.end(), a.begin(), a.end());
    corners.insert(corners.end(), b.begin(), b.end());
  };
  for (const Touched& touched : touched_) {
    const double reach = cube_size * touched.radius * input_.scene.frame().unit(1);
    std::array<double, 3> from = low, to = high;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = input_.scene.seeds.positions[3 * std::size_t{touched.rank} + k];
      from[k] = std::max(low[k], x - reach);
      to[k] = std::min(high[k], x + reach);
    }
    add(from, to);
  }
  add(low, high);
  return corners;
}

void Chunk::clip_cells(std::optional<ClipMemory>& memory, ClipStatistics& statistics, SideHints& hints) {
  if (touched_.empty()) return;
  const RegionMesh boxes_mesh = boxes_around(input_.domain, boxes());
  const DomainBuffers on_device(input_.scene.context(), boxes_mesh, false);
  const Scene scene{on_device, input_.scene.buffers, input_.scene.seeds, input_.scene.tree};
  Clipper clipper(scene, input_.in_space, OUTPUT_MOMENTS | OUTPUT_WALLS | OUTPUT_GEOMETRY,
                  {true, input_.threads, true}, std::exchange(memory, std::nullopt));
  std::vector<std::uint32_t> ranks, regions;
  std::vector<std::size_t> which;
  for (std::size_t t = 0; t < touched_.size(); ++t) {
    which.push_back(t);
    ranks.push_back(touched_[t].rank);
    regions.push_back(static_cast<std::uint32_t>(t));
  }
  compute(clipper.clip(ranks, regions), which, false, hints);
  std::erase_if(which, [&](std::size_t t) { return outcome_[t].kind != Kind::again; });
  if (!which.empty()) {
    ranks.clear();
    for (const std::size_t t : which) ranks.push_back(touched_[t].rank);
    regions.assign(which.size(), static_cast<std::uint32_t>(touched_.size()));
    compute(clipper.clip(ranks, regions), which, true, hints);
  }
  statistics.add(clipper.statistics());
  memory = std::move(clipper).release();
}

void Chunk::compute(const PieceSet& cells, std::span<const std::size_t> which, bool in_container,
                    SideHints& hints) {
  const std::size_t tasks = (which.size() + cells_of_task - 1) / cells_of_task;
  std::vector<CellInSolid> in_solid(static_cast<std::size_t>(std::max(1, input_.threads)));
  parallel_tasks(input_.threads, tasks, [&](int worker, std::size_t task) {
    const std::size_t end = std::min(which.size(), (task + 1) * cells_of_task);
    for (std::size_t k = task * cells_of_task; k < end; ++k)
      compute_one(in_solid[static_cast<std::size_t>(worker)], cells, k, touched_[which[k]], in_container,
                  outcome_[which[k]], hints);
  });
}

void Chunk::compute_one(CellInSolid& in_solid, const PieceSet& cells, std::size_t pair,
                        const Touched& touched, bool in_container, Outcome& outcome, SideHints& hints) const {
  outcome.kind = in_container ? Kind::unclear : Kind::again;
  if (cells.status[pair] == PIECE_EMPTY) return;
  const WholeCell cell = whole_cell(cells, pair);
  in_solid.start(touched.rank, cell, input_.scene.seeds.positions);
  std::vector<double> memory;
  const std::vector<BoundaryPiece> pieces = pieces_of(touched, memory);
  for (const BoundaryPiece& piece : pieces) in_solid.add(piece);
  if (!in_solid.label()) return;
  if (touched.tied && !has_tetrahedra_) find_coincidences(in_solid, cell, touched, outcome);
  if (!in_solid.uniform()) {
    if (in_solid.is_open()) return;
    outcome.part[0] = in_solid.part();
    if (input_.faces) outcome.faces[0] = make_cell_faces({in_solid, pieces, rounding_});
    leave_hints(touched.rank, in_solid, cell, hints);
    if (has_tetrahedra_)
      outcome.kind = touched.tied || outcome.part[0].thin ? Kind::unclear : Kind::done;
    else
      outcome.kind = outcome.part[0].flat ? Kind::flat : Kind::done;
    return;
  }
  if (!in_container) return;  // its side is that of its neighbours, all of which must be known
  for (const std::int32_t border : cell.border) {
    if (border >= 0)
      outcome.neighbors.push_back(static_cast<std::uint32_t>(border));
    else
      outcome.reaches_out = true;
  }
  for (const Side side : {Side::outside, Side::inside}) {
    in_solid.set_sides(side);
    outcome.part[side == Side::inside] = in_solid.part();
    if (input_.faces && !(side == Side::inside && outcome.reaches_out))
      outcome.faces[side == Side::inside] = make_cell_faces({in_solid, pieces, rounding_});
  }
  outcome.kind = touched.tied && has_tetrahedra_ ? Kind::unclear : Kind::uniform;
}

std::vector<BoundaryPiece> Chunk::pieces_of(const Touched& touched, std::vector<double>& memory) const {
  std::vector<BoundaryPiece> pieces;
  pieces.reserve(touched.last - touched.first);
  memory.reserve(9 * (touched.last - touched.first));  // so that spans of it stay valid
  for (std::size_t p = touched.first; p < touched.last; ++p) {
    const auto [triangle, pair] = piece_[p];
    const std::size_t slot = 3 * std::size_t{triangle};
    BoundaryPiece& piece = pieces.emplace_back();
    piece.edges = std::span(input_.boundary.edges).subspan(slot, 3);
    piece.triangle = triangle;
    piece.corners = std::span(input_.boundary.mesh.region_vertex).subspan(slot, 3);
    if (pair == whole) {
      const std::array<double, 9> x = corners_of(triangle, touched.rank);
      memory.insert(memory.end(), x.begin(), x.end());
      piece.border = whole_border;
      piece.vertex = std::span<const double>(memory).last(9);
    } else {
      piece.border = borders_of(*clipped_, pair);
      piece.vertex = vertices_of(*clipped_, pair);
    }
  }
  return pieces;
}

/// A triangle in the plane of a wall whose inner side is that of the neighbour bounds nothing of this cell
/// but an infinitesimal slice.
void Chunk::find_coincidences(const CellInSolid& in_solid, const WholeCell& cell, const Touched& touched,
                              Outcome& outcome) const {
  const RegionMesh& mesh = input_.boundary.mesh;
  const std::vector<double>& seeds = input_.scene.seeds.positions;
  outcome.coincidences.clear();
  for (std::size_t p = touched.first; p < touched.last; ++p) {
    const std::uint32_t* const corner = &mesh.region_vertex[3 * std::size_t{piece_[p].triangle}];
    const auto at = [&](std::size_t k) { return &mesh.vertices[3 * std::size_t{corner[k]}]; };
    const Point normal = cross(difference<double>(at(1), at(0)), difference<double>(at(2), at(0)));
    for (const std::int32_t border : cell.border) {
      if (border < 0) continue;
      const auto neighbor = static_cast<std::uint32_t>(border);
      const Point q =
          difference<double>(&seeds[3 * std::size_t{neighbor}], &seeds[3 * std::size_t{touched.rank}]);
      const bool in_plane = dot(normal, q) < 0 && std::all_of(corner, corner + 3, [&](std::uint32_t v) {
                              return corner_side(*host_scene_, touched.rank, v, border) == 0;
                            });
      if (in_plane)
        outcome.coincidences.push_back(
            {touched.rank, neighbor, piece_[p].triangle, in_solid.piece_area(p - touched.first)});
    }
  }
}

void Chunk::leave_hints(std::uint32_t rank, const CellInSolid& in_solid, const WholeCell& cell,
                        SideHints& hints) const {
  const auto add = [&](std::uint32_t seen_rank, std::uint8_t what) { add_bits(hints.seen[seen_rank], what); };
  add(rank, SideHints::looked);
  for (std::uint32_t v = 0; v < cell.vertices(); ++v) {
    const std::uint32_t* const faces = &cell.link[6 * std::size_t{v} + 3];
    const bool is_vertex =
        std::all_of(faces, faces + 3, [&](std::uint32_t f) { return cell.border[f] >= 0; });
    const std::uint8_t seen = in_solid.side(v) == Side::inside ? SideHints::inside : SideHints::outside;
    for (std::size_t k = 0; k < 3; ++k)
      // A face that the boundary does not meet lies on one side, however much of it the cube has cut off.
      if (cell.border[faces[k]] >= 0 && (is_vertex || !in_solid.is_cut(faces[k])))
        add(static_cast<std::uint32_t>(cell.border[faces[k]]), seen);
  }
}

void Chunk::append_to(SolidCells& all) {
  all.unclear.insert(all.unclear.end(), tied_alone_.begin(), tied_alone_.end());
  for (std::size_t t = 0; t < touched_.size(); ++t) {
    const std::uint32_t rank = touched_[t].rank;
    Outcome& outcome = outcome_[t];
    if (outcome.kind == Kind::done)
      all.cells.push_back({rank, std::move(outcome.part[0]), std::move(outcome.faces[0])});
    if (outcome.kind == Kind::uniform)
      all.uniform.push_back({rank, std::move(outcome.neighbors), outcome.reaches_out, std::move(outcome.part),
                             std::move(outcome.faces)});
    if (outcome.kind == Kind::unclear) all.unclear.push_back(rank);
    if (outcome.kind == Kind::flat) all.flat.push_back(rank);
    all.coincidences.insert(all.coincidences.end(), outcome.coincidences.begin(), outcome.coincidences.end());
  }
}

}  // namespace powercell::solid
