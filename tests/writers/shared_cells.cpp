// Cells that share their points and walls: laws that need no other result.
#include "apps/io/write/shared_cells.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "apps/io/read/domain.hpp"
#include "apps/io/write/shared_points.hpp"
#include "tests/writers/clip_pieces.hpp"
#include "tests/writers/made_diagram.hpp"
#include "tests/writers/real_diagram.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Loop = std::vector<std::uint32_t>;

Point at(const io::SharedCells& cells, std::uint32_t p) {
  const double* x = cells.point(p);
  return {x[0], x[1], x[2]};
}

/// The loop from its least point on.
Loop turned(Loop loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

Loop loop_of(const io::SharedCells& cells, std::uint64_t f) {
  return {cells.face(f).begin(), cells.face(f).end()};
}

double volume(const io::SharedCells& cells, std::size_t i) {
  if (cells.face_offset[i] == cells.face_offset[i + 1]) return 0;
  const Point origin = at(cells, cells.face(cells.face_offset[i])[0]);
  double sum = 0;
  for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f) {
    const Loop loop = loop_of(cells, f);
    for (std::size_t k = 2; k < loop.size(); ++k)
      sum += dot(at(cells, loop[0]) - origin,
                 cross(at(cells, loop[k - 1]) - origin, at(cells, loop[k]) - origin)) /
             6;
  }
  return sum;
}

/// Vertices less edges plus faces, and in how many connected parts they are.
std::pair<int, int> euler(const io::SharedCells& cells, std::size_t i) {
  std::set<std::uint32_t> points;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f) {
    const Loop loop = loop_of(cells, f);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      points.insert(loop[k]);
      edges.insert(std::minmax(loop[k], loop[(k + 1) % loop.size()]));
    }
  }
  std::map<std::uint32_t, std::uint32_t> part;
  for (const std::uint32_t p : points) part[p] = p;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : edges) {
      const std::uint32_t least = std::min(part[a], part[b]);
      changed = changed || part[a] != least || part[b] != least;
      part[a] = part[b] = least;
    }
  }
  std::set<std::uint32_t> parts;
  for (const auto& [p, of] : part) parts.insert(of);
  const auto faces = static_cast<int>(cells.face_offset[i + 1] - cells.face_offset[i]);
  return {static_cast<int>(points.size()) - static_cast<int>(edges.size()) + faces,
          static_cast<int>(parts.size())};
}

/// Each inner wall occurs exactly twice, once each way round; each face at the boundary once.
void check_walls(const io::SharedCells& cells) {
  std::map<Loop, std::vector<std::uint32_t>> cells_of;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f)
      cells_of[turned(loop_of(cells, f))].push_back(i);
  std::size_t faults = 0;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f) {
      Loop back = loop_of(cells, f);
      std::reverse(back.begin(), back.end());
      const auto found = cells_of.find(turned(back));
      faults += cells_of.at(turned(loop_of(cells, f))).size() != 1;
      if (cells.face_border[f].kind == Border::Kind::wall) {
        faults += found == cells_of.end() || found->second != Loop{cells.face_border[f].index};
        faults += cells.twin[cells.twin[f]] != f || cells.twin[f] == f;
      } else {
        faults += cells.face_border[f].kind != Border::Kind::boundary || found != cells_of.end();
      }
    }
  CHECK(faults == 0);
}

/// No point of another cell lies inside an edge: such a point would be a gap in a mesh of the cells.
std::size_t points_in_edges(const io::SharedCells& cells) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> points(cells.loop.begin(), cells.loop.end());
  double largest = 0;
  for (const double x : cells.points) largest = std::max(largest, std::fabs(x));
  for (std::uint64_t f = 0; f < cells.face_count(); ++f)
    for (std::size_t k = 0; k < cells.face(f).size(); ++k)
      edges.insert(std::minmax(cells.face(f)[k], cells.face(f)[(k + 1) % cells.face(f).size()]));
  std::size_t count = 0;
  for (const auto& [a, b] : edges) {
    const Point along = at(cells, b) - at(cells, a);
    for (const std::uint32_t p : points) {
      if (p == a || p == b) continue;
      const Point to = at(cells, p) - at(cells, a);
      const double share = dot(to, along) / dot(along, along);
      if (share <= 1e-6 || share >= 1 - 1e-6) continue;
      const Point off = to - along * share;
      count +=
          std::sqrt(dot(off, off)) < 1e-9 * std::min(1.0, std::sqrt(dot(along, along))) + 1e-13 * largest;
    }
  }
  return count;
}

}  // namespace

TEST_CASE(
    "the walls of volumes are the same face in both cells, and the faces of a cell enclose its measure") {
  for (RealDiagram& real : volume_cases()) {
    CAPTURE(real.name);
    const io::DiagramOutput output = real.output();
    const io::SharedCells cells = io::share_cells(output);
    CHECK(cells.fault == "");
    check_walls(cells);
    const double tolerance = real.name == "single precision"          ? 1e-5
                             : real.name == "box far from the origin" ? 1e-6  // digits of the coordinates
                                                                      : 1e-9;
    const double mean = output.measures.domain_measure / static_cast<double>(output.seeds.size());
    for (std::size_t i = 0; i < cells.cell_count(); ++i) {
      CAPTURE(i);
      CHECK(std::fabs(volume(cells, i) - output.measures.mass[i]) <= tolerance * mean);
      const bool box = real.name.rfind("box", 0) == 0 || real.name == "lattice";
      if (output.measures.status[i] == SeedStatus::ok && box) CHECK(euler(cells, i) == std::pair(2, 1));
    }
  }
}

TEST_CASE("cells that share walls have no points in the middle of an edge") {
  for (RealDiagram& real : volume_cases()) {
    CAPTURE(real.name);
    if (real.name == "single precision" || real.name == "box far from the origin")
      continue;                        // as thick as points
    if (real.name == "box") continue;  // one region, many points
    CHECK(points_in_edges(io::share_cells(real.output())) == 0);
  }
}

TEST_CASE("the cells of a lattice are cubes with eight points") {
  RealDiagram real = real_diagram("lattice", io::read_domain("cube").domain, lattice_points(4, 3));
  const io::SharedCells cells = io::share_cells(real.output());
  CHECK(cells.point_count() == 125);
  for (std::size_t i = 0; i < cells.cell_count(); ++i) {
    CHECK(cells.points_of(i).size() == 8);
    CHECK(cells.face_offset[i + 1] - cells.face_offset[i] == 6);
  }
}

TEST_CASE("the convex pieces share their points too") {
  RealDiagram real = random_diagram("ball", io::read_domain("ball:3").domain, 40);
  const io::DiagramOutput output = real.output();
  const io::SharedPoints points = io::share_points(output);
  std::map<Loop, int> times;
  const Cells& cells = output.cells;
  std::size_t boundary = 0;
  for (std::size_t p = 0; p < cells.piece_count(); ++p)
    for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
      Loop loop;
      for (std::uint64_t e = cells.loop_offset[f]; e < cells.loop_offset[f + 1]; ++e)
        loop.push_back(points.number[cells.vertex_offset[p] + cells.loop[e]]);
      boundary += cells.border[f].kind == Border::Kind::boundary;
      Loop back(loop.rbegin(), loop.rend());
      ++times[turned(loop)];
      --times[turned(back)];
    }
  std::size_t once = 0;
  for (const auto& [loop, count] : times) once += count > 0 ? static_cast<std::size_t>(count) : 0;
  CHECK(once == boundary);  // all other faces are there both ways round
}

TEST_CASE("cells of polygons and surfaces share the ends of their walls") {
  for (RealDiagram& real : flat_cases()) {
    CAPTURE(real.name);
    const io::DiagramOutput output = real.output();
    const io::SharedCells cells = io::share_cells(output);
    CHECK(cells.fault == "");
    std::size_t walls = 0;
    std::map<std::array<std::uint32_t, 4>, int> sides;  // seeds, then points
    for (std::uint32_t i = 0; i < cells.cell_count(); ++i) {
      double area = 0;
      for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f) {
        std::vector<Point> corners;
        const auto loop = cells.face(f);
        for (std::size_t k = 0; k < loop.size(); ++k) {
          corners.push_back(at(cells, loop[k]));
          const Border& border = cells.edge_border[cells.loop_offset[f] + k];
          const std::uint32_t next = loop[(k + 1) % loop.size()];
          CHECK(loop[k] != next);
          if (border.kind != Border::Kind::wall) continue;
          ++walls;
          ++sides[{i, border.index, std::min(loop[k], next), std::max(loop[k], next)}];
        }
        Point twice{};
        for (std::size_t k = 2; k < corners.size(); ++k)
          twice = twice + cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
        area += (output.domain.kind() == DomainKind::polygon ? twice[2] : std::sqrt(dot(twice, twice))) / 2;
      }
      CHECK(area == doctest::Approx(output.measures.mass[i]).epsilon(1e-9));
    }
    CHECK(walls > 0);
    for (const auto& [key, count] : sides) {
      CHECK(count == 1);
      CHECK(sides.count({key[1], key[0], key[2], key[3]}) == 1);
    }
  }
}

TEST_CASE("images of a point in a periodic domain stay apart, and cells still close") {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  RealDiagram real = random_diagram("periodic", Domain::periodic_box(low, high), 40);
  const io::DiagramOutput output = real.output();
  const io::SharedCells cells = io::share_cells(output);
  CHECK(cells.fault == "");
  std::size_t shared = 0, moved = 0;
  for (std::size_t i = 0; i < cells.cell_count(); ++i) {
    CHECK(volume(cells, i) == doctest::Approx(output.measures.mass[i]).epsilon(1e-9));
    for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f) {
      const bool is_moved = cells.shift[f] != std::array<std::int32_t, 3>{};
      CHECK((cells.twin[f] == f) == is_moved);
      ++(is_moved ? moved : shared);
    }
  }
  CHECK(shared > 0);
  CHECK(moved > 0);
}

TEST_CASE("a diagram made by another program is shared as well") {
  for (const MadeDiagram& made : {volume_diagram(30), polygon_diagram(60), surface_diagram(20)}) {
    const io::SharedCells cells = io::share_cells(made.output());
    CHECK(cells.fault == "");
    CHECK(cells.point_count() <
          made.joined.vertices.size() / static_cast<std::size_t>(made.joined.dimension));
  }
}

TEST_CASE("cells that do not fit together are refused, with their seed and the way out") {
  MadeDiagram made = volume_diagram(12);
  // Takes a wall from the cell that is to give it to both.
  const auto first = std::find_if(
      made.cells.border.begin(), made.cells.border.end(),
      [](const Border& border) { return border.kind == Border::Kind::wall && border.index == 11; });
  REQUIRE(first != made.cells.border.end());
  first->index = 10;
  CHECK(io::share_cells(made.output()).fault.find("the cell of seed") != std::string::npos);
  CHECK_THROWS_WITH_AS(io::fitting_cells("x.msh", made.output()), doctest::Contains("--decisions exact"),
                       Error);
}
