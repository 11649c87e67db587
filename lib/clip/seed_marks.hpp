/// \file
/// A set of seeds for one cell at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace powercell {

/// Ranks of seeds. Clearing it costs next to nothing.
class SeedMarks {
 public:
  SeedMarks() : slot_(least_slots) {}
  void clear() {
    count_ = 0;
    if (++round_ == 0) {  // after 2^32 cells
      slot_.assign(slot_.size(), 0);
      round_ = 1;
    }
  }
  /// False if it was there.
  bool insert(std::int32_t seed) {
    if (2 * (count_ + 1) > slot_.size()) grow();
    const std::uint64_t entry = std::uint64_t{round_} << 32 | static_cast<std::uint32_t>(seed);
    std::uint64_t& slot = place_of(entry);
    if (slot == entry) return false;
    slot = entry;
    ++count_;
    return true;
  }

 private:
  static constexpr std::size_t least_slots = 256;

  /// Where the entry is or goes: slots of other rounds are free.
  std::uint64_t& place_of(std::uint64_t entry) {
    std::size_t at = static_cast<std::uint32_t>(entry) * 0x9E3779B1U >> 8;
    for (;; ++at) {
      std::uint64_t& slot = slot_[at & (slot_.size() - 1)];
      if (slot == entry || slot >> 32 != round_) return slot;
    }
  }
  void grow() {
    std::vector<std::uint64_t> before(2 * slot_.size());
    before.swap(slot_);
    for (const std::uint64_t entry : before)
      if (entry >> 32 == round_) place_of(entry) = entry;
  }

  std::vector<std::uint64_t> slot_;
  std::uint32_t round_ = 1;
  std::size_t count_ = 0;
};

}  // namespace powercell
