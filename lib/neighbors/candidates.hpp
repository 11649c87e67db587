/// \file
/// Candidate neighbours for the clip kernels: the interface between search and clipping.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "lib/cl/program.hpp"
#include "lib/scene/scene.hpp"

namespace powercell {

/// A clip kernel (kernels/clip/by_*.cl) and the buffers that it reads candidates from.
class Candidates {
 public:
  virtual ~Candidates() = default;
  virtual std::string_view file() const = 0;    ///< kernel source
  virtual std::string_view kernel() const = 0;  ///< kernel name
  /// Appends the arguments that follow those common to all clip kernels (PIECE_ARGUMENTS).
  virtual void append_arguments(cl::Kernel& kernel) const = 0;
  /// Candidates of the same kind for the golden diagram: a small scene in which every seed may be a neighbour
  /// of every other and meet every region.
  virtual std::unique_ptr<Candidates> for_scene(const Scene& scene) const = 0;
  /// The same candidates on another device, which has the same domain, seeds and tree. Reads from this device
  /// what is not on the host.
  /// \throw Error opencl, out_of_device_memory, build_failed
  virtual std::unique_ptr<Candidates> on(const Scene& scene) const = 0;

  // For lists of candidates, which are made for each launch. The tree needs none of this.

  /// Whether two clippers may use them at once: nothing is made for a launch.
  virtual bool is_shared() const { return true; }
  /// Maximum number of pairs in one launch of this round.
  virtual std::size_t most_pairs(int /*round*/) const { return std::numeric_limits<std::uint32_t>::max(); }
  /// Makes the lists of these ranks, ascending. Round r > 0 makes longer lists for the pairs that ended with
  /// PIECE_MORE in round r-1.
  virtual void prepare(std::span<const std::uint32_t> /*ranks*/, int /*round*/) {}
  /// OUTPUT_... (kernels/layout.h) in addition to those of the clipper.
  virtual int outputs() const { return 0; }
  /// Seconds spent in prepare() on the host since construction.
  virtual double host_seconds() const { return 0; }
};

}  // namespace powercell
