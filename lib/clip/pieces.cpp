#include "lib/clip/pieces.hpp"

#include <algorithm>

namespace powercell {

void PieceBatch::keep() {
  if (!lent_border) return;
  border.resize(face_offset.back());
  wall.resize(face_offset.back());
  for (std::size_t row = 0; row + 1 < face_offset.size(); ++row) {
    std::copy_n(borders(row), faces(row), border.data() + face_offset[row]);
    std::copy_n(walls(row), faces(row), wall.data() + face_offset[row]);
  }
  lent_border = nullptr;
  lent_wall = nullptr;
}

}  // namespace powercell
