#include "lib/exchange/cell_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <powercell/error.hpp>

namespace powercell::exchange {
namespace {

/// Numbers of seeds are below those of images, these below those of facets, and these below those of regions.
constexpr std::uint64_t first_image = std::uint64_t{1} << 61, first_facet = std::uint64_t{1} << 62,
                        first_region = std::uint64_t{1} << 63;

Shift operator-(const Shift& a, const Shift& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace

void CellVertices::find_faces(const Cells& cells, std::size_t piece) {
  const std::uint64_t vertices = cells.vertex_offset[piece + 1] - cells.vertex_offset[piece],
                      first = cells.face_offset[piece], last = cells.face_offset[piece + 1];
  face_.assign(vertices, {});
  faces_.assign(vertices, 0);
  const auto d = static_cast<std::size_t>(cells.cell_dimension);
  const auto meet = [&](std::uint64_t vertex, std::uint64_t face) {
    if (faces_[vertex] == d)
      throw Error(ErrorCode::internal,
                  "a vertex of a cell is in more faces than a vertex has; please report the input");
    face_[vertex][faces_[vertex]++] = face;
  };
  for (std::uint64_t f = first; f < last; ++f) {
    if (d == 2) {
      meet(f - first, f);
      meet((f - first + 1) % vertices, f);
      continue;
    }
    for (std::uint64_t k = cells.loop_offset[f]; k < cells.loop_offset[f + 1]; ++k) meet(cells.loop[k], f);
  }
}

void CellVertices::number_images(std::array<std::uint64_t, 4>& seed, std::array<Shift, 4>& shift,
                                 std::size_t count) {
  // Of the images of a vertex that one is meant in which its lowest seed is not moved.
  std::size_t lowest = 0;
  for (std::size_t k = 1; k < count; ++k)
    if (std::pair(seed[k], shift[k]) < std::pair(seed[lowest], shift[lowest])) lowest = k;
  const Shift base = shift[lowest];
  for (std::size_t k = 0; k < count; ++k) {
    const Shift from_base = shift[k] - base;
    if (from_base == Shift{}) continue;
    seed[k] = images_.try_emplace({seed[k], from_base}, first_image + images_.size()).first->second;
  }
}

bool CellVertices::add_name(const Cells& cells, std::size_t piece, std::size_t vertex, Handle self,
                            std::span<const Handle> handle) {
  std::array<std::uint64_t, 4> seed{self}, other{};
  std::array<Shift, 4> shift{};
  std::size_t seeds = 1, others = 0, inner = 0;
  for (std::size_t k = 0; k < faces_[vertex]; ++k) {
    const std::uint64_t face = face_[vertex][k];
    const Border border = cells.border[face];
    inner += border.kind == Border::Kind::interior;
    if (border.kind != Border::Kind::wall) {
      other[others++] = (border.kind == Border::Kind::boundary ? first_facet : first_region) + border.index;
      continue;
    }
    if (!cells.shift.empty()) shift[seeds] = cells.shift[face];
    seed[seeds++] = handle[border.index];
  }
  // The pieces in the other regions around it have the vertex on the boundary of the cell, if it is there.
  if (inner == faces_[vertex]) return false;
  if (!cells.shift.empty()) number_images(seed, shift, seeds);
  VertexName name;
  name.part.fill(std::numeric_limits<std::uint64_t>::max());
  name.part[0] = cells.region[piece];
  std::copy_n(other.begin(), others, std::copy_n(seed.begin(), seeds, name.part.begin() + 1));
  std::sort(name.part.begin() + 1, name.part.end());
  name_.push_back(name);
  return true;
}

void CellVertices::set(const Cells& cells, std::size_t row, const double* seed, Handle self,
                       std::span<const Handle> handle) {
  const auto d = static_cast<std::size_t>(cells.dimension);
  offset_.clear();
  name_.clear();
  for (std::uint64_t p = cells.cell_offset[row]; p < cells.cell_offset[row + 1]; ++p) {
    find_faces(cells, p);
    for (std::size_t v = 0; v < faces_.size(); ++v) {
      if (!add_name(cells, p, v, self, handle)) continue;
      Point& y = offset_.emplace_back();
      for (std::size_t k = 0; k < d; ++k)
        y[k] = cells.vertices[(cells.vertex_offset[p] + v) * d + k] - seed[k];
    }
  }
}

double radius_of(const Cells& cells, std::size_t row, const double* seed) {
  const auto d = static_cast<std::size_t>(cells.dimension);
  double most = 0;
  const std::uint64_t first = cells.vertex_offset[cells.cell_offset[row]],
                      last = cells.vertex_offset[cells.cell_offset[row + 1]];
  for (std::uint64_t v = first; v < last; ++v) {
    double square = 0;
    for (std::size_t k = 0; k < d; ++k) {
      const double y = cells.vertices[v * d + k] - seed[k];
      square += y * y;
    }
    most = std::max(most, square);
  }
  return std::max(std::sqrt(most), least_radius);
}

}  // namespace powercell::exchange
