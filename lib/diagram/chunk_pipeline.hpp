/// \file
/// A queue of clips: devices clip chunks of pairs, each in a thread of its own, while the caller completes
/// them in order. Chunks are shared out by the speeds of the devices.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <powercell/device.hpp>
#include <span>
#include <thread>
#include <vector>

#include "lib/cl/quirks.hpp"
#include "lib/clip/clipper.hpp"
#include "lib/diagram/clip_plan.hpp"
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
  void set_pairs(const ClipPlan& plan, std::uint64_t first, std::uint64_t last);
  /// Sets pair_seed from pair_row.
  void set_seeds(const ClipPlan& plan);
};

/// What clipping is the same on all devices.
struct ClipWork {
  const DiagramSetup& setup;
  const ActiveSeeds& active;
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
std::uint64_t chunk_pairs(const DiagramSetup& setup, const Device& device, std::uint64_t total);

/// Hands the items [0, total) out in ascending ranges that all take about the same time, and shorter ones
/// towards the end, so that all devices end together. Not thread-safe.
class Sharing {
 public:
  struct Member {
    std::uint64_t most = 0;  ///< items of a range
    double speed = 0;        ///< items a second; 0 where it is not known
  };
  struct Range {
    std::uint64_t begin = 0, end = 0;
    bool empty() const { return begin == end; }
  };

  /// \param least  items of a range that are worth a launch; the last range may have fewer
  Sharing(std::uint64_t total, std::uint64_t least, const std::vector<Member>& members);

  /// The next range for a member, which takes part from its first range on. Empty if nothing is left, or if
  /// the others would end before this member had done its part; it has left then.
  Range take(std::size_t member);
  /// How long a range took. Later ones count as much as all before them.
  void took(std::size_t member, std::uint64_t items, double seconds);
  /// Ranges of this member have at most so many items from now on.
  void limit(std::size_t member, std::uint64_t most);

  double speed(std::size_t member) const { return members_[member].speed; }

 private:
  struct State : Member {
    bool takes_part = false;
  };
  std::uint64_t size_for(std::size_t member) const;
  /// The sum of the speeds of all that take part, but `member`.
  double speed_of_others(std::size_t member) const;

  std::uint64_t total_, least_, next_ = 0;
  std::vector<State> members_;
};

class ChunkPipeline {
 public:
  /// A chunk that a device has done with.
  struct Done {
    std::size_t device;  ///< its number
    ClipChunk* chunk;
    bool is_clipped;  ///< false where the device ran out of memory
  };

  /// Devices, plan and sharing must outlive this.
  /// \param chunks  that a device has at a time: 1 or 2
  ChunkPipeline(std::deque<ClipDevice>& devices, const ClipPlan& plan, Sharing& sharing, std::size_t chunks);
  ChunkPipeline(const ChunkPipeline&) = delete;
  ChunkPipeline& operator=(const ChunkPipeline&) = delete;
  /// Waits until the devices have ended what they do now.
  ~ChunkPipeline();

  /// Starts the threads, as many as the system gives.
  /// \return false if there is none
  bool start();
  /// Waits for the chunk that begins with a pair, the one after that of the call before.
  /// \throw what a device's thread has thrown, whatever its chunk
  Done wait_for(std::uint64_t begin);
  /// The device may use the chunk again.
  void release(const Done& done);
  /// Stops the device of a chunk, and frees the memory of all its chunks: those that were clipped already
  /// become such that ran out of memory. Until release() the device is the caller's, and has one chunk at a
  /// time from then on.
  void take_over(const Done& done);
  /// Chunks of a device have at most so many pairs from now on.
  void limit(std::size_t device, std::uint64_t most);

 private:
  enum class Stage { free, taken, done };
  struct Slot {
    ClipChunk* chunk = nullptr;
    Stage stage = Stage::free;
    bool is_clipped = false;
  };
  struct Lane {
    std::vector<Slot> slots;
    bool one_at_a_time = false;
    std::thread thread;
  };

  /// The thread of a device.
  void run(std::size_t device) noexcept;
  /// Takes a range into a free chunk; waits for one.
  /// \return null if there is nothing more to do
  Slot* take(std::size_t device);
  static Slot* usable(Lane& lane);
  void clip(std::size_t device, Slot& slot);

  std::deque<ClipDevice>& devices_;
  const ClipPlan& plan_;
  Sharing& sharing_;
  std::deque<Lane> lanes_;
  std::mutex mutex_;  // guards what follows, slots, lanes and the sharing
  std::condition_variable changed_;
  bool stopped_ = false;
  std::exception_ptr failure_;
};

}  // namespace powercell
