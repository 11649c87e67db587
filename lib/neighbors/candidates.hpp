/// \file
/// Where a clip kernel gets its candidate neighbours: the seam between search and clipping. Internal.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "lib/cl/program.hpp"
#include "lib/scene/scene.hpp"

namespace powercell {

/// A kernel of kernels/clip/by_*.cl, and the buffers that it finds candidates in.
class Candidates {
 public:
  virtual ~Candidates() = default;
  virtual std::string_view file() const = 0;    ///< kernel source
  virtual std::string_view kernel() const = 0;  ///< kernel name
  /// Sets the arguments behind the common ones of the clip kernels, from `first` on.
  virtual void set_arguments(cl::Kernel& kernel, unsigned first) const = 0;
  /// Candidates of the same kind for a small scene in which every seed may be a neighbour of every other and
  /// meet every region: what the golden diagram is clipped with.
  virtual std::unique_ptr<Candidates> for_scene(const Scene& scene) const = 0;

  // Lists of candidates are made for each launch; the tree needs none of what follows.

  /// The most pairs of one launch in this round.
  virtual std::size_t most_pairs(int /*round*/) const { return std::numeric_limits<std::uint32_t>::max(); }
  /// Makes the lists of these ranks, ascending. In round r > 0 they are longer, for pairs that ended with
  /// PIECE_MORE in round r-1.
  virtual void prepare(std::span<const std::uint32_t> /*ranks*/, int /*round*/) {}
  /// OUTPUT_... of kernels/layout.h to add to those of the clipper.
  virtual int outputs() const { return 0; }
  /// Seconds spent in prepare() on the host since construction.
  virtual double host_seconds() const { return 0; }
};

}  // namespace powercell
