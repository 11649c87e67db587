/// \file
/// How work over many items is cut into tiles, of which each is one work-item's.
#pragma once

#include <algorithm>
#include <cstdint>

namespace powercell {

struct Tiles {
  std::uint32_t size;   ///< items of a tile; the last may have fewer
  std::uint32_t count;  ///< of tiles
};

/// \param items     at least 1
/// \param smallest  a tile has at least so many items if there are as many
/// \param most      of tiles, at least 1
inline Tiles tiles_of(std::uint32_t items, std::uint32_t smallest, std::uint32_t most) {
  const std::uint32_t wanted = std::clamp(items / smallest, 1u, most), size = (items - 1) / wanted + 1;
  return {size, (items - 1) / size + 1};
}

}  // namespace powercell
