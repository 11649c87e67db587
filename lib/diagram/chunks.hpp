/// \file
/// One pass over all pairs, chunk by chunk: clip → gather → collect.
#pragma once

#include "lib/clip/clipper.hpp"
#include "lib/collect/geometry.hpp"
#include "lib/collect/walls.hpp"
#include "lib/diagram/state.hpp"

namespace powercell {

class ChunkRun {
 public:
  ChunkRun(Diagram::State& state, bool want_adjacency, bool want_cells);
  /// Fills the measures of the state, and its adjacency and cells where asked. On an exception the
  /// state's results stay as they were.
  void run();

 private:
  void clip_all();
  /// Clips, gathers and collects the pairs [begin, end).
  void clip_chunk(std::uint64_t begin, std::uint64_t end);
  /// Adds the moments of the pairs [begin, end) of the chunk, of the ranks [first_rank, last_rank], to
  /// the sums.
  void gather(std::uint64_t begin, std::uint64_t end, std::uint32_t first_rank, std::uint32_t last_rank);
  std::uint32_t rank_of(std::uint64_t pair) const;
  std::vector<double> read_sums() const;
  Measures make_measures() const;
  std::uint64_t chunk_pairs() const;

  Diagram::State& s_;
  bool want_adjacency_, want_cells_;
  int outputs_;
  cl::RawBuffer sums_;  // ranks x (2 + dimension) reals
  cl::Buffer<std::uint32_t> offset_, clear_;
  std::unique_ptr<cl::Kernel> gather_kernel_;
  std::unique_ptr<Clipper> clipper_;
  WallCollector walls_;
  GeometryCollector geometry_;
  double collect_seconds_ = 0;
};

}  // namespace powercell
