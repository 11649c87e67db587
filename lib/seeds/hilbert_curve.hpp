/// \file
/// Keys of the Hilbert curve on a grid of 2^bits cells along each axis. Internal.
#pragma once

#include <array>
#include <cstdint>

namespace powercell {

/// The curve is walked by a table: in state s the curve enters the cell's 2^D children in an order that is a
/// mirrored and rotated Gray code. A state is the pair (corner where the curve enters, axis along which it
/// leaves), as in Hamilton and Rau-Chaplin, "Compact Hilbert indices" (2008), section 2.
template <int D>
struct HilbertTable {
  static constexpr unsigned children = 1u << D;
  static constexpr unsigned states = children * D;
  struct Step {
    std::uint8_t order = 0;  ///< place of the child along the curve
    std::uint8_t state = 0;  ///< state within the child
  };
  std::array<std::array<Step, children>, states> step{};

  constexpr HilbertTable() {
    for (unsigned entry = 0; entry < children; ++entry)
      for (unsigned axis = 0; axis < D; ++axis)
        for (unsigned child = 0; child < children; ++child) {
          const unsigned w = gray_rank(rotated_right(child ^ entry, axis + 1));
          const unsigned child_entry = entry ^ rotated_left(entry_of(w), axis + 1);
          const unsigned child_axis = (axis + axis_of(w) + 1) % D;
          step[entry * D + axis][child] = {static_cast<std::uint8_t>(w),
                                           static_cast<std::uint8_t>(child_entry * D + child_axis)};
        }
  }

 private:
  static constexpr unsigned rotated_left(unsigned v, unsigned by) {
    by %= D;
    return ((v << by) | (v >> (D - by))) & (children - 1);
  }
  static constexpr unsigned rotated_right(unsigned v, unsigned by) { return rotated_left(v, D - by % D); }
  static constexpr unsigned gray(unsigned w) { return w ^ (w >> 1); }
  static constexpr unsigned gray_rank(unsigned code) {
    unsigned w = 0;
    for (; code != 0; code >>= 1) w ^= code;
    return w;
  }
  static constexpr unsigned entry_of(unsigned w) { return w == 0 ? 0 : gray((w - 1) / 2 * 2); }
  static constexpr unsigned axis_of(unsigned w) {
    if (w == 0) return 0;
    unsigned ones = 0;
    for (unsigned v = w % 2 == 0 ? w - 1 : w; v % 2 != 0; v /= 2) ++ones;
    return ones % D;
  }
};

/// Bits along each axis, so that a key fills at most 63 bits.
template <int D>
inline constexpr int hilbert_bits = D == 2 ? 31 : 21;

/// Place along the curve of the grid cell `cell`, each coordinate below 2^hilbert_bits<D>.
template <int D>
constexpr std::uint64_t hilbert_key(const std::array<std::uint32_t, D>& cell) {
  constexpr HilbertTable<D> table;
  std::uint64_t key = 0;
  unsigned state = 0;
  for (int bit = hilbert_bits<D> - 1; bit >= 0; --bit) {
    unsigned child = 0;
    for (int k = 0; k < D; ++k) child |= ((cell[static_cast<std::size_t>(k)] >> bit) & 1u) << k;
    const auto step = table.step[state][child];
    key = (key << D) | step.order;
    state = step.state;
  }
  return key;
}

}  // namespace powercell
