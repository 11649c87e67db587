#include <cmath>
#include <random>

#include "lib/verify/laws.hpp"

namespace powercell {

LawCheck check_bisectors(const Cells& cells, const Rounding& rounding) {
  Worst worst;
  for (std::size_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
      for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
        if (cells.border[f].kind != Border::Kind::wall) continue;
        const std::uint32_t j = cells.border[f].index;
        for (const Vector& vertex : face_corners(cells, p, f))
          worst.see(
              static_cast<double>(std::fabs(rounding.beyond(i, j, vertex))), rounding.wall_shift(i, j), [&] {
                return "a vertex of the wall of seeds " + std::to_string(i) + " and " + std::to_string(j);
              });
      }
  return worst.result("bisectors: walls lie where two power distances are equal",
                      rounding.unit() * rounding.diagonal());
}

LawCheck check_vertices(const Cells& cells, const Rounding& rounding, const VerifyOptions& options) {
  std::vector<std::size_t> owner;  // of each vertex
  for (std::size_t i = 0; i < cells.cell_count(); ++i)
    owner.resize(cells.vertex_offset[cells.cell_offset[i + 1]], i);
  Worst worst;
  std::mt19937_64 random(options.random_seed);
  for (std::size_t sample = 0; !owner.empty() && sample < options.samples; ++sample) {
    const std::size_t v = random() % owner.size(), i = owner[v];
    const Vector vertex = cell_vertex(cells, v);
    for (std::size_t j = 0; j < cells.cell_count(); ++j) {
      if (rounding.position(j) == rounding.position(i)) continue;  // the law of statuses looks at these
      const auto beyond = static_cast<double>(rounding.beyond(i, j, vertex));
      if (beyond <= 0) continue;
      worst.see(beyond, rounding.wall_shift(i, j), [&] {
        return "a vertex of the cell of seed " + std::to_string(i) + " belongs to seed " + std::to_string(j);
      });
    }
  }
  return worst.result("ownership: no seed is nearer to a vertex than its cell's",
                      rounding.unit() * rounding.diagonal());
}

}  // namespace powercell
