/// \file
/// One pass over all pairs, chunk by chunk: clip → integrate → collect.
#pragma once

#include "lib/clip/clipper.hpp"
#include "lib/collect/geometry.hpp"
#include "lib/collect/walls.hpp"
#include "lib/diagram/state.hpp"
#include "lib/integrate/moment_sums.hpp"

namespace powercell {

class ChunkRun {
 public:
  ChunkRun(Diagram::State& state, bool want_adjacency, bool want_cells);
  /// Fills the measures of the state, and its adjacency and cells where asked. On an exception the
  /// state's results stay as they were, and so they do where ranks come back: their cells need the regions of
  /// the domain.
  std::vector<std::uint32_t> run();
  /// After run(): ranks of exactly flat cells, whose walls lie between those on either side of them. Where
  /// there are any, the results of the state stayed as they were.
  const std::vector<std::uint32_t>& flat_cells() const { return flat_; }

 private:
  void clip_all();
  void keep_wall_memory();
  /// Clips and collects the pairs [begin, end).
  void clip_chunk(std::uint64_t begin, std::uint64_t end);
  std::uint32_t rank_of(std::uint64_t pair) const;
  std::uint64_t chunk_pairs() const;

  Diagram::State& s_;
  bool want_adjacency_, want_cells_;
  int outputs_;
  std::unique_ptr<Clipper> clipper_;
  MomentSums measures_;
  WallCollector walls_;
  GeometryCollector geometry_;
  std::vector<std::uint32_t> pair_seed_;
  std::vector<std::uint32_t> flat_;  // ranks with a flat piece, then those that have nothing else
  double collect_seconds_ = 0;
};

}  // namespace powercell
