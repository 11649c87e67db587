/// \file
/// One of the devices that clip the pairs of a pass, and its chunks of them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <powercell/device.hpp>
#include <span>
#include <vector>

#include "lib/cl/quirks.hpp"
#include "lib/clip/clipper.hpp"
#include "lib/diagram/device_errors.hpp"
#include "lib/diagram/plan.hpp"
#include "lib/diagram/setup.hpp"

namespace powercell {

struct ClipChunk {
  std::uint64_t begin = 0, end = 0;          ///< of the pairs of a plan
  std::vector<std::uint32_t> pair_row;       ///< of each pair
  std::vector<std::uint32_t> selected_seed;  ///< the same by rank, if cells are selected
  std::span<const std::uint32_t> pair_seed;  ///< the same by rank
  std::span<const std::uint32_t> pair_region;
  std::optional<Clipper> clipper;
  std::vector<std::uint32_t> for_host;  ///< once the device has clipped the chunk: the pairs to finish here

  /// Makes this the pairs [first, last) of a plan, which must not be empty.
  void set_pairs(const Plan& plan, std::uint64_t first, std::uint64_t last);
  /// Sets pair_seed from pair_row.
  void set_seeds(const Plan& plan);
};

/// What clipping is the same on all devices.
struct ClipWork {
  const Setup& setup;
  const Active& active;
  int outputs = 0;  ///< of clippers
  ClipOptions options = {};
};

class ClipDevice {
 public:
  /// The first device of a group, or the only one.
  /// \param kept  memory from earlier passes; gets it back by keep_memory()
  ClipDevice(const ClipWork& work, const Device& device, DeviceWorkspace& kept, Candidates& candidates);
  /// A further device, to be prepared.
  /// \param first  the candidates on the first device
  /// \param copy   those on this one: null before they are made
  ClipDevice(const ClipWork& work, const Device& device, DeviceWorkspace& kept, const Candidates& first,
             std::unique_ptr<Candidates>& copy);

  /// On a further device uploads the seeds, makes the candidates and compiles, where that was not done
  /// before.
  /// \throw Error opencl, out_of_device_memory, build_failed, self_test_failed
  void prepare();
  /// Clips a chunk, one of chunks(), on the device.
  /// \throw as prepare(); internal
  void clip(ClipChunk& chunk);
  /// Frees the memory of a chunk that is not in use.
  void free_memory(ClipChunk& chunk);
  /// Leaves small memory to the next pass.
  void keep_memory();
  /// Calls `body`, which uses the device. Of a group, errors of the device name it.
  template <class Body>
  void use(const Body& body) const {
    const auto lock = cl::call_alone(device_.info());
    on_device(work_.setup, device_, body);
  }

  /// Of which the device clips one while the host completes the other.
  std::array<ClipChunk, 2>& chunks() { return chunks_; }
  const Device& device() const { return device_; }
  const Candidates& candidates() const { return *candidates_; }

 private:
  Scene scene() const;
  Clipper make_clipper(std::size_t chunk);

  const ClipWork work_;
  const Device device_;
  DeviceWorkspace& kept_;
  const Candidates* first_ = nullptr;
  std::unique_ptr<Candidates>* copy_ = nullptr;
  Candidates* candidates_;  // null before a further device is prepared
  std::array<ClipChunk, 2> chunks_;
};

inline constexpr std::uint64_t least_chunk_pairs = 1024;

/// The number of pairs of a chunk on one device, of `total`; 0 pairs stand for very many.
std::uint64_t chunk_pairs(const Setup& setup, const Device& device, std::uint64_t total);

}  // namespace powercell
