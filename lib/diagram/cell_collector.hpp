/// \file
/// Collects what the chunks of a pass come to into results.
#pragma once

#include <optional>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/collect/geometry.hpp"
#include "lib/collect/walls.hpp"
#include "lib/diagram/chunk_pipeline.hpp"
#include "lib/diagram/clip.hpp"
#include "lib/integrate/moment_sums.hpp"

namespace powercell {

class CellCollector {
 public:
  /// Keeps the references.
  /// \param workspace  its memory of walls is taken, and given back by finish()
  CellCollector(const DiagramSetup& setup, ActiveSeeds& active, ClipPlan& plan, Wanted want,
                Workspace& workspace);

  /// What the kernels are to write.
  int outputs() const;
  /// Adds the next chunk, which the host has completed.
  /// \throw Error out_of_device_memory, before anything is added; opencl
  void add(ClipChunk& chunk, const PieceSet& pieces);
  /// Adds a chunk of cells that were taken by take_beyond().
  /// \throw Error as add
  void replace(ClipChunk& chunk, const PieceSet& pieces);

  /// In a periodic domain: whether cells reach beyond the margin in which there are images.
  bool has_beyond() const { return !beyond_.empty(); }
  std::size_t beyond() const { return beyond_.size(); }  ///< how many
  double margin() const { return margin_; }              ///< that these need
  /// Per seed, by rank, the distance within which it has all its neighbours.
  std::span<const double> clearance() const { return clearance_; }
  /// Strikes off those that are proved by a wider margin without further images.
  void prove_again();
  /// Removes what was collected of these.
  /// \return their rows, ascending
  std::vector<std::uint32_t> take_beyond();

  /// To be called once.
  Clipped finish();
  double seconds() const { return seconds_; }

 private:
  /// The moments of a chunk that the host completes.
  static PairMoments moments(ClipChunk& chunk) {
    return {chunk.clipper->moments_on_host(),
            [&chunk]() -> const cl::RawBuffer& { return chunk.clipper->moments(); }};
  }
  /// Cells that the boundary does not cut lie on the side of their neighbours, which are needed for that.
  bool collects_walls() const { return want_.adjacency || plan_.solid; }
  /// The seeds of the cells to compute, row by row: by rank unless they are selected.
  const SeedSet& row_seeds() const { return plan_.selected ? plan_.selected->seeds : active_.seeds(); }
  /// The number of cells to compute; images, which are seeds behind them, have none.
  std::size_t row_count() const {
    return plan_.selected     ? plan_.selected->rank.size()
           : active_.images() ? active_.images()->own
                              : active_.seeds().size();
  }
  std::uint32_t rank_of_row(std::uint32_t row) const {
    return plan_.selected ? plan_.selected->rank[row] : row;
  }
  /// Collects the pieces of a chunk, all but their measures.
  void collect(const ClipChunk& chunk, const PieceSet& pieces);
  /// Lists the cells that reach beyond the margin.
  void prove_reach(const ClipChunk& chunk, const PieceSet& pieces);
  void keep_reach(const ClipChunk& chunk, const PieceSet& pieces);
  /// Finishes the measures, and names the ranks because of which the pass must be repeated.
  Measures finish_measures(Clipped& results, std::vector<CellAtBoundary>& at_boundary);
  std::optional<Adjacency> finish_adjacency(const std::vector<SeedStatus>& status);
  /// Moves the centroids from near the wrapped seeds to near those given.
  void place_centroids(Measures& measures) const;
  std::vector<CoincidentWall> coincident_walls(const std::vector<SeedStatus>& status) const;
  void keep_wall_memory();

  const DiagramSetup& setup_;
  ActiveSeeds& active_;
  ClipPlan& plan_;
  const Wanted want_;
  Workspace& workspace_;
  MomentSums measures_;
  WallCollector walls_;
  GeometryCollector geometry_;
  std::vector<std::uint32_t> flat_;  // the row of each flat piece
  // In a periodic domain:
  std::optional<Placement> placement_;
  std::optional<MarginProof> proof_;
  std::vector<std::uint32_t> beyond_;  // ascending: rows of cells that reach too far
  double margin_ = 0;                  // that these need
  std::vector<double> clearance_;      // by rank; infinite for cells that are not known
  std::vector<double> reach_;          // by row of the results
  double seconds_ = 0;
};

}  // namespace powercell
