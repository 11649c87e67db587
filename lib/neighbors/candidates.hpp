/// \file
/// Where a clip kernel gets its candidate neighbours from: the seam between search and clipping.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "lib/cl/program.hpp"

namespace powercell {

class Scene;

/// One source of candidates. A launch is prepared for its seeds, then adds its arguments behind the
/// common ones of the clip kernels (kernels/clip/by_*.cl).
class Candidates {
 public:
  virtual ~Candidates() = default;
  virtual std::string_view file() const = 0;    ///< kernel source
  virtual std::string_view kernel() const = 0;  ///< kernel name

  /// Most pairs one launch may have in this round, for the memory of the lists.
  virtual std::size_t most_pairs(int round) const = 0;
  /// Readies candidates for pairs with these ranks (ascending); in round r > 0 for pairs that ended
  /// with PIECE_MORE in round r-1.
  virtual void prepare(std::span<const std::uint32_t> ranks, int round) = 0;
  /// Sets the arguments from `first` on.
  virtual void set_arguments(cl::Kernel& kernel, unsigned first) = 0;
  /// OUTPUT_... of kernels/layout.h that this source adds to those of the clipper.
  virtual int outputs() const { return 0; }
  /// The regions whose pieces together are that of the pair, where the host clips them: it knows no more than
  /// regions and seeds.
  virtual std::vector<std::uint32_t> regions_for_host(std::uint32_t /*rank*/, std::uint32_t region) const {
    return {region};
  }
  /// The same source for another scene.
  virtual std::unique_ptr<Candidates> for_scene(const Scene& scene) const = 0;
  /// Seconds spent on the host in prepare() since construction.
  virtual double host_seconds() const { return 0; }
};

}  // namespace powercell
