/// \file
/// The cells at the boundary of a solid, computed from the boundary alone.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lib/clip/clipper.hpp"
#include "lib/domain/outline.hpp"
#include "lib/neighbors/tree_candidates.hpp"
#include "lib/pairs/pair_finder.hpp"
#include "lib/solid/cell_faces.hpp"
#include "lib/solid/cell_in_solid.hpp"

namespace powercell {

/// The boundary of a domain, kept with it.
struct BoundaryTriangles {
  RegionMesh mesh;                   ///< outward triangles (boundary_surface)
  std::vector<std::uint32_t> edges;  ///< per slot of a triangle: the number of its edge

  explicit BoundaryTriangles(const RegionMesh& domain)
      : mesh(boundary_surface(domain)), edges(edge_numbers(mesh)) {}
};

/// The same for one diagram. Not movable.
struct SolidBoundary {
  std::shared_ptr<const BoundaryTriangles> kept;
  const RegionMesh& mesh;
  const std::vector<std::uint32_t>& edges;
  DomainBuffers on_device;
  PairFinder pairs;

  SolidBoundary(const std::shared_ptr<cl::Context>& context, const RegionMesh& domain, int threads)
      : kept(domain.kept.get<BoundaryTriangles>([&] { return std::make_shared<BoundaryTriangles>(domain); })),
        mesh(kept->mesh),
        edges(kept->edges),
        on_device(context, mesh, false),
        pairs(mesh, threads) {}
  SolidBoundary(const SolidBoundary&) = delete;
  SolidBoundary& operator=(const SolidBoundary&) = delete;
};

/// Where vertices of each cell were seen from neighbouring cells, by rank.
struct SideHints {
  static constexpr std::uint8_t outside = 1, inside = 2;
  static constexpr std::uint8_t looked = 4;  ///< the sides of the cell's own vertices are known
  std::vector<std::uint8_t> seen;
};

/// The cells that the boundary meets. Lengths are in device units.
struct SolidCells {
  struct Cell {
    std::uint32_t rank;
    solid::SolidPart part;
    solid::CellFaces faces;  ///< empty unless asked for
  };
  /// A cell whose edges the boundary does not cross.
  struct UniformCell {
    std::uint32_t rank;
    std::vector<std::uint32_t> neighbors;     ///< of the whole cell
    bool reaches_out = false;                 ///< beyond the container, so that its vertices lie outside
    std::array<solid::SolidPart, 2> part{};   ///< if its vertices lie outside, and inside
    std::array<solid::CellFaces, 2> faces{};  ///< likewise
  };
  std::vector<Cell> cells;           ///< ranks ascend
  std::vector<UniformCell> uniform;  ///< ranks ascend
  /// Ascending: cells that must be computed by tetrahedra. Of a solid without any, only those that contradict
  /// themselves, which is a defect.
  std::vector<std::uint32_t> unclear;
  // Of solids without tetrahedra:
  std::vector<std::uint32_t> flat;  ///< ascending: cells with parts no thicker than rounding
  /// The part of a wall that lies in a boundary triangle, and so is none: that of the cell which has only an
  /// infinitesimal slice there.
  struct Coincidence {
    std::uint32_t rank, neighbor, triangle;
    double area;
  };
  std::vector<Coincidence> coincidences;
  SideHints hints;
};

struct SolidCellsInput {
  const RegionMesh& domain;
  const SolidBoundary& boundary;
  const Scene& scene;                       ///< the seeds; of any domain with the same frame
  const Pairs& pairs;                       ///< of the boundary's triangles
  std::span<const std::uint32_t> excluded;  ///< ranks, in any order, that are computed in another way
  Candidates& on_facets;                    ///< candidates for the pieces of triangles
  Candidates& in_space;                     ///< for whole cells
  std::uint64_t chunk_pairs;                ///< the most pairs to clip at once
  bool faces;                               ///< whether to make the surfaces of the parts too
  int threads;
  const std::function<bool(double)>& progress;
};

/// Buffers for the next call.
struct SolidMemory {
  std::optional<ClipMemory> facets, cells;
};

/// Computes all cells that the boundary meets, with exact decisions.
/// \throw Error as Clipper::clip; interrupted
SolidCells compute_solid_cells(const SolidCellsInput& input, SolidMemory& memory, ClipStatistics& statistics);

}  // namespace powercell
