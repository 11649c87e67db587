/// \file
/// Points in Hilbert order.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// Indices of the finite `points` (n x dimension, row-major) along a Hilbert curve through their bounding
/// cube. Points that share a grid cell are ordered along a curve through their own bounding cube, so clusters
/// far below the grid's resolution are in good order too. Equal positions are consecutive, by ascending
/// index. The order does not depend on `threads`.
std::vector<std::uint32_t> hilbert_order(std::span<const double> points, int dimension, int threads);

/// The places of points along one Hilbert curve through the cube at `low` that contains the box up to `high`:
/// of 62 or 63 bits, equal for points that share a cell of its grid.
/// \pre the points are in the box; `low` and `high` have `dimension` finite coordinates unless there are no
/// points
std::vector<std::uint64_t> hilbert_keys(std::span<const double> points, int dimension,
                                        std::span<const double> low, std::span<const double> high,
                                        int threads);

/// Transitions of the curve: in each state it visits the 2^D children of a cell in a mirrored and rotated
/// Gray code. A state is the pair (corner where the curve enters, axis along which it leaves), as in Hamilton
/// and Rau-Chaplin, "Compact Hilbert indices" (2008), section 2.
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

/// Bits along each axis; a key has at most 63.
template <int D>
inline constexpr int hilbert_bits = D == 2 ? 31 : 21;

/// The same transitions, several levels at a time: a lookup waits for the state of the one before, so fewer
/// lookups mean less latency.
template <int D>
struct HilbertLevels {
  static constexpr int levels = D == 2 ? 3 : 2;
  static constexpr unsigned paths = 1u << (D * levels);
  /// By state and path, which is the child of each level, from the top down.
  std::array<std::array<typename HilbertTable<D>::Step, paths>, HilbertTable<D>::states> step{};
  /// The bits of one coordinate, spaced D apart.
  std::array<std::uint8_t, 1u << levels> spread{};

  constexpr HilbertLevels() {
    const HilbertTable<D> single;
    for (unsigned from = 0; from < HilbertTable<D>::states; ++from)
      for (unsigned path = 0; path < paths; ++path) {
        unsigned order = 0, state = from;
        for (int level = levels - 1; level >= 0; --level) {
          const auto next = single.step[state][path >> (D * level) & (HilbertTable<D>::children - 1)];
          order = order << D | next.order;
          state = next.state;
        }
        step[from][path] = {static_cast<std::uint8_t>(order), static_cast<std::uint8_t>(state)};
      }
    for (unsigned bits = 0; bits < spread.size(); ++bits)
      for (int level = 0; level < levels; ++level)
        spread[bits] |= static_cast<std::uint8_t>((bits >> level & 1u) << (D * level));
  }
};

template <int D>
inline constexpr HilbertTable<D> hilbert_table{};
template <int D>
inline constexpr HilbertLevels<D> hilbert_levels{};

/// Position along the curve of a grid cell with coordinates below 2^hilbert_bits<D>.
template <int D>
constexpr std::uint64_t hilbert_key(const std::array<std::uint32_t, D>& cell) {
  constexpr int levels = HilbertLevels<D>::levels;
  static_assert(hilbert_bits<D> % levels == 1);
  // The path of `width` levels: bits [low, low + width) of each coordinate.
  const auto path = [&cell](int low, int width) {
    unsigned bits = 0;
    for (int k = 0; k < D; ++k)
      bits |=
          unsigned{hilbert_levels<D>.spread[cell[static_cast<std::size_t>(k)] >> low & ((1u << width) - 1)]}
          << k;
    return bits;
  };
  int bit = hilbert_bits<D> - 1;
  auto step = hilbert_table<D>.step[0][path(bit, 1)];
  std::uint64_t key = step.order;
  while ((bit -= levels) >= 0) {
    step = hilbert_levels<D>.step[step.state][path(bit, levels)];
    key = key << (D * levels) | step.order;
  }
  return key;
}

}  // namespace powercell
