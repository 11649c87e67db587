#include "tests/support/permuted.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace powercell::test {
namespace {

Permutation inverse(const Permutation& from) {
  Permutation to(from.size());
  for (std::uint32_t k = 0; k < from.size(); ++k) to[from[k]] = k;
  return to;
}

/// Rows of `width` values in the original order.
template <class T>
std::vector<T> rows(const std::vector<T>& values, const Permutation& from) {
  std::vector<T> result(values.size());
  if (from.empty()) return result;
  const std::size_t width = values.size() / from.size();
  for (std::size_t k = 0; k < from.size(); ++k)
    std::copy_n(&values[k * width], width, &result[from[k] * width]);
  return result;
}

/// Appends the entries [begin, end) of an array.
template <class T>
void append(std::vector<T>& to, const std::vector<T>& values, std::uint64_t begin, std::uint64_t end) {
  to.insert(to.end(), values.begin() + static_cast<std::ptrdiff_t>(begin),
            values.begin() + static_cast<std::ptrdiff_t>(end));
}

}  // namespace

Permutation random_permutation(std::size_t n, Random& random) {
  Permutation from(n);
  std::iota(from.begin(), from.end(), 0u);
  for (std::size_t k = n; k > 1; --k) std::swap(from[k - 1], from[random.index(k)]);
  return from;
}

SeedArray permuted(const SeedArray& seeds, const Permutation& from) {
  SeedArray result{seeds.dimension, {}, {}};
  const auto d = static_cast<std::size_t>(seeds.dimension);
  for (const std::uint32_t i : from) {
    append(result.positions, seeds.positions, i * d, (i + 1) * d);
    result.weights.push_back(seeds.weights[i]);
  }
  return result;
}

Measures restored(const Measures& measures, const Permutation& from) {
  Measures result = measures;
  result.mass = rows(measures.mass, from);
  result.centroid = rows(measures.centroid, from);
  result.second_moment = rows(measures.second_moment, from);
  result.status = rows(measures.status, from);
  return result;
}

Adjacency restored(const Adjacency& adjacency, const Permutation& from) {
  Adjacency result;
  result.asymmetry = adjacency.asymmetry;
  for (std::size_t side = 0; side < 2 && adjacency.asymmetry > 0; ++side)
    result.asymmetric[side] = from[adjacency.asymmetric[side]];
  result.offset = {0};
  for (const std::uint32_t row : inverse(from)) {
    std::vector<std::pair<std::uint32_t, double>> entries;
    for (std::uint64_t e = adjacency.offset[row]; e < adjacency.offset[row + 1]; ++e)
      entries.emplace_back(from[adjacency.neighbor[e]], adjacency.wall[e]);
    std::sort(entries.begin(), entries.end());
    for (const auto& [neighbor, wall] : entries) {
      result.neighbor.push_back(neighbor);
      result.wall.push_back(wall);
    }
    result.offset.push_back(result.neighbor.size());
  }
  return result;
}

Cells restored(const Cells& cells, const Permutation& from) {
  Cells result;
  result.dimension = cells.dimension;
  result.cell_dimension = cells.cell_dimension;
  result.cell_offset = result.vertex_offset = result.face_offset = {0};
  if (!cells.loop_offset.empty()) result.loop_offset = {0};
  const auto d = static_cast<std::uint64_t>(cells.dimension);
  for (const std::uint32_t cell : inverse(from)) {
    for (std::uint64_t p = cells.cell_offset[cell]; p < cells.cell_offset[cell + 1]; ++p) {
      result.region.push_back(cells.region[p]);
      append(result.vertices, cells.vertices, cells.vertex_offset[p] * d, cells.vertex_offset[p + 1] * d);
      result.vertex_offset.push_back(result.vertices.size() / d);
      for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
        Border border = cells.border[f];
        if (border.kind == Border::Kind::wall) border.index = from[border.index];
        result.border.push_back(border);
        if (cells.loop_offset.empty()) continue;
        append(result.loop, cells.loop, cells.loop_offset[f], cells.loop_offset[f + 1]);
        result.loop_offset.push_back(result.loop.size());
      }
      result.face_offset.push_back(result.border.size());
    }
    result.cell_offset.push_back(result.region.size());
  }
  return result;
}

Dual restored(const Dual& dual, const Permutation& from) {
  // As the library writes them: rows ascend, and seeds within a row, except that orientation may swap the
  // last two.
  const auto corners = static_cast<std::size_t>(dual.corners);
  std::vector<std::array<std::uint32_t, 4>> list;
  for (std::size_t r = 0; r < dual.size(); ++r) {
    std::array<std::uint32_t, 4> row{};
    for (std::size_t k = 0; k < corners; ++k) row[k] = from[dual.simplices[r * corners + k]];
    bool odd = false;
    for (std::size_t a = 0; a < corners; ++a)
      for (std::size_t b = a + 1; b < corners; ++b) odd ^= row[a] > row[b];
    std::sort(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(corners));
    if (odd) std::swap(row[corners - 1], row[corners - 2]);
    list.push_back(row);
  }
  std::sort(list.begin(), list.end());
  Dual result;
  result.corners = dual.corners;
  for (const auto& row : list)
    result.simplices.insert(result.simplices.end(), row.begin(),
                            row.begin() + static_cast<std::ptrdiff_t>(corners));
  return result;
}

Results restored(const Results& results, const Permutation& from) {
  return {restored(results.measures, from), restored(results.adjacency, from), restored(results.cells, from),
          restored(results.dual, from)};
}

}  // namespace powercell::test
