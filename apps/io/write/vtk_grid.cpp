#include "apps/io/write/vtk_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "apps/io/write/shared_cells.hpp"
#include "apps/io/write/shared_points.hpp"

namespace powercell::io {
namespace {

using SpacePoint = std::array<double, 3>;
using Corners = std::span<const std::uint32_t>;

SpacePoint vector_product(const SpacePoint& a, const SpacePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Elements as lists of faces, in any order. A polygon is its only face.
struct Elements {
  std::vector<std::uint32_t> loop;
  std::vector<std::uint64_t> loop_offset = {0};
  std::vector<std::uint64_t> face_offset = {0};
  std::vector<std::uint32_t> seed, region;

  /// Adds a face without points that repeat the one before, if a polygon is left.
  void add_face(std::span<const std::uint32_t> corners) {
    const std::size_t before = loop.size();
    for (const std::uint32_t p : corners)
      if (loop.size() == before || loop.back() != p) loop.push_back(p);
    while (loop.size() > before + 1 && loop.back() == loop[before]) loop.pop_back();
    if (loop.size() < before + 3)
      loop.resize(before);
    else
      loop_offset.push_back(loop.size());
  }
  /// Ends an element, and drops one that has no extent.
  void end_element(std::uint32_t of_seed, std::uint32_t of_region, std::size_t least_faces) {
    if (loop_offset.size() - 1 - face_offset.back() < least_faces) {
      loop_offset.resize(face_offset.back() + 1);
      loop.resize(loop_offset.back());
      return;
    }
    face_offset.push_back(loop_offset.size() - 1);
    seed.push_back(of_seed);
    region.push_back(of_region);
  }
  std::size_t size() const { return seed.size(); }
  Corners face(std::uint64_t f) const {
    return Corners(loop).subspan(loop_offset[f], loop_offset[f + 1] - loop_offset[f]);
  }
};

/// The points of an element, each once, ascending; of a polygon in order.
std::vector<std::uint32_t> corners(const Elements& elements, std::size_t element, bool polyhedra) {
  const auto begin = elements.loop.begin() +
                     static_cast<std::ptrdiff_t>(elements.loop_offset[elements.face_offset[element]]),
             end = elements.loop.begin() +
                   static_cast<std::ptrdiff_t>(elements.loop_offset[elements.face_offset[element + 1]]);
  std::vector<std::uint32_t> points(begin, end);
  if (!polyhedra) return points;
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

class GridMaker {
 public:
  GridMaker(std::vector<double> points, int cell_dimension) {
    grid_.points = std::move(points);
    grid_.cell_dimension = cell_dimension;
  }

  VtkGrid make(const Elements& elements) {
    for (const std::size_t element : order(elements)) {
      for (const std::uint32_t p : corners(elements, element, polyhedra())) grid_.connectivity.push_back(p);
      grid_.offsets.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
      grid_.seed.push_back(elements.seed[element]);
      grid_.region.push_back(elements.region[element]);
      const std::uint64_t begin = elements.face_offset[element], end = elements.face_offset[element + 1];
      grid_.size.push_back(polyhedra() ? volume(elements, begin, end) : area(elements.face(begin)));
      if (!polyhedra()) continue;
      grid_.faces.push_back(static_cast<std::int64_t>(end - begin));
      for (std::uint64_t f = begin; f < end; ++f) {
        grid_.faces.push_back(static_cast<std::int64_t>(elements.face(f).size()));
        for (const std::uint32_t p : elements.face(f)) grid_.faces.push_back(p);
      }
      grid_.face_offsets.push_back(static_cast<std::int64_t>(grid_.faces.size()));
    }
    return std::move(grid_);
  }

 private:
  bool polyhedra() const { return grid_.cell_dimension == 3; }

  /// Polyhedra by the number of their points: meshio groups them by it and mixes up the data of the groups in
  /// any other order.
  std::vector<std::size_t> order(const Elements& elements) const {
    std::vector<std::size_t> order(elements.size()), points(elements.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (!polyhedra()) return order;
    for (std::size_t k = 0; k < order.size(); ++k) points[k] = corners(elements, k, true).size();
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
    return order;
  }

  SpacePoint from(std::uint32_t p, std::uint32_t origin) const {
    const double *x = &grid_.points[3 * std::size_t{p}], *o = &grid_.points[3 * std::size_t{origin}];
    return {x[0] - o[0], x[1] - o[1], x[2] - o[2]};
  }
  double area(Corners loop) const {
    SpacePoint sum{};
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const SpacePoint n = vector_product(from(loop[k], loop[0]), from(loop[k + 1], loop[0]));
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += n[axis];
    }
    return 0.5 * std::hypot(sum[0], sum[1], sum[2]);
  }
  /// By the divergence theorem.
  double volume(const Elements& elements, std::uint64_t begin, std::uint64_t end) const {
    const std::uint32_t origin = elements.face(begin)[0];
    double six_volumes = 0;
    for (std::uint64_t f = begin; f < end; ++f) {
      const Corners loop = elements.face(f);
      const SpacePoint a = from(loop[0], origin);
      for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
        const SpacePoint n = vector_product(from(loop[k], origin), from(loop[k + 1], origin));
        six_volumes += a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
      }
    }
    return six_volumes / 6;
  }

  VtkGrid grid_;
};

/// A polyhedron has four faces, or two where nearly all of it is within rounding.
constexpr std::size_t least_faces = 2;

Elements elements_of(const Cells& cells, const SharedPoints& points) {
  Elements elements;
  std::vector<std::uint32_t> face;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      const std::uint64_t first = cells.vertex_offset[p];
      if (cells.cell_dimension == 2) {
        elements.add_face(std::span(points.number).subspan(first, cells.vertex_offset[p + 1] - first));
        elements.end_element(i, cells.region[p], 1);
        continue;
      }
      for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
        face.clear();
        for (std::uint64_t e = cells.loop_offset[f]; e < cells.loop_offset[f + 1]; ++e)
          face.push_back(points.number[first + cells.loop[e]]);
        elements.add_face(face);
      }
      elements.end_element(i, cells.region[p], least_faces);
    }
  return elements;
}

Elements elements_of(const JoinedCells& joined, const SharedPoints& points) {
  Elements elements;
  std::vector<std::uint32_t> face;
  for (std::uint32_t i = 0; i + 1 < joined.face_offset.size(); ++i) {
    for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f) {
      face.clear();
      for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e)
        face.push_back(points.number[joined.vertex_offset[i] + joined.loop[e]]);
      elements.add_face(face);
    }
    elements.end_element(i, 0, least_faces);
  }
  return elements;
}

}  // namespace

VtkGrid grid_of_pieces(const DiagramOutput& output) {
  SharedPoints points = share_points(output);
  const Elements elements =
      output.domain.is_solid() ? elements_of(output.joined, points) : elements_of(output.cells, points);
  return GridMaker(std::move(points.at), output.domain.cell_dimension()).make(elements);
}

VtkGrid grid_of_cells(const std::string& path, const DiagramOutput& output) {
  SharedCells shared = fitting_cells(path, output);
  Elements elements;
  for (std::uint32_t i = 0; i < shared.cell_count(); ++i) {
    for (std::uint64_t f = shared.face_offset[i]; f < shared.face_offset[i + 1]; ++f)
      elements.add_face(shared.face(f));
    elements.end_element(i, 0, least_faces);
  }
  VtkGrid grid = GridMaker(std::move(shared.points), 3).make(elements);
  grid.region.clear();
  return grid;
}

}  // namespace powercell::io
