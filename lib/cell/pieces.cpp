#include "lib/cell/pieces.hpp"

#include <algorithm>
#include <iterator>

namespace powercell {

void PieceBatch::copy_mapped() {
  if (!mapped_border) return;
  border.resize(face_offset.back());
  wall.resize(face_offset.back());
  for (std::size_t row = 0; row + 1 < face_offset.size(); ++row) {
    std::copy_n(borders(row), faces(row), border.data() + face_offset[row]);
    std::copy_n(walls(row), faces(row), wall.data() + face_offset[row]);
  }
  mapped_border = nullptr;
  mapped_wall = nullptr;
}

bool PieceBatch::row_repeats(std::size_t row) const {
  std::vector<std::int32_t> seed;
  std::copy_if(borders(row), borders(row) + faces(row), std::back_inserter(seed),
               [](std::int32_t behind) { return behind >= 0; });
  std::sort(seed.begin(), seed.end());
  return std::adjacent_find(seed.begin(), seed.end()) != seed.end();
}

}  // namespace powercell
