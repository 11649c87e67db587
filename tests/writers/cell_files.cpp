// Files of cells that share walls, read back: STL, Gmsh and neper.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "apps/io/read/domain.hpp"
#include "apps/io/read/mesh.hpp"
#include "apps/io/write/output.hpp"
#include "tests/writers/clip_pieces.hpp"
#include "tests/writers/real_diagram.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Triangles of one body.
struct Body {
  double volume = 0;
  std::map<std::pair<Point, Point>, int> edges;  // forth less back
  void add(const Point& a, const Point& b, const Point& c) {
    volume += dot(a, cross(b, c)) / 6;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      ++edges[{from, to}];
      --edges[{to, from}];
    }
  }
  bool closed() const {
    for (const auto& [edge, count] : edges)
      if (count != 0) return false;
    return true;
  }
};

void check_bodies(const std::map<std::uint32_t, Body>& bodies, const Measures& measures) {
  CHECK(bodies.size() == measures.count(SeedStatus::ok));
  for (const auto& entry : bodies) {
    const std::uint32_t seed = entry.first;
    const Body& body = entry.second;
    CAPTURE(seed);
    CHECK(body.closed());
    CHECK(body.volume == doctest::Approx(measures.mass[seed]).epsilon(1e-7));  // positive: seen from outside
  }
}

std::map<std::uint32_t, Body> bodies_of_stl(const std::string& path) {
  std::istringstream text(read_all(path));
  std::map<std::uint32_t, Body> bodies;
  std::string word, name;
  while (text >> word) {
    REQUIRE(word == "solid");
    text >> name;
    REQUIRE(name.rfind("cell_", 0) == 0);
    Body& body = bodies[static_cast<std::uint32_t>(std::stoul(name.substr(5)))];
    for (text >> word; word == "facet"; text >> word) {
      Point normal, corner[3];
      text >> word >> normal[0] >> normal[1] >> normal[2] >> word >> word;
      for (Point& x : corner) text >> word >> x[0] >> x[1] >> x[2];
      text >> word >> word;
      REQUIRE(word == "endfacet");
      body.add(corner[0], corner[1], corner[2]);
      const Point turn = cross(corner[1] - corner[0], corner[2] - corner[0]);
      CHECK(dot(normal, turn) >= 0);
    }
    REQUIRE(word == "endsolid");
    text >> word;
    CHECK(word == name);
  }
  return bodies;
}

/// A Gmsh 4.1 file in text.
struct Msh {
  std::vector<Point> points{1};                                    // from 1
  std::map<std::pair<int, int>, std::string> names;                // dimension, tag
  std::map<std::pair<int, int>, std::vector<int>> groups, bounds;  // dimension, tag of the entity
  std::map<std::pair<int, int>, std::vector<std::vector<int>>> elements;

  explicit Msh(const std::string& path) {
    std::istringstream lines(read_all(path)), text(lines.str());
    for (std::string line, next; std::getline(lines, line);) {
      if (line.rfind("$End", 0) == 0 || line[0] != '$' || line == "$MeshFormat") continue;
      REQUIRE(std::getline(lines, next));  // the counts of a section are alone in its first line
      CHECK(split(next, ' ').size() == (line == "$PhysicalNames" ? 1 : 4));
    }
    for (std::string word; text >> word;) {
      if (word == "$PhysicalNames") read_names(text);
      if (word == "$Entities") read_entities(text);
      if (word == "$Nodes") read_nodes(text);
      if (word == "$Elements") read_elements(text);
    }
  }
  void read_names(std::istream& text) {
    int count, dimension, tag;
    text >> count;
    for (int k = 0; k < count; ++k) {
      std::string name;
      text >> dimension >> tag >> name;
      names[{dimension, tag}] = name.substr(1, name.size() - 2);
    }
  }
  void read_entities(std::istream& text) {
    int counts[4];
    for (int& count : counts) text >> count;
    double x;
    for (int dimension = 0; dimension < 4; ++dimension)
      for (int k = 0; k < counts[dimension]; ++k) {
        int tag, count, value;
        text >> tag;
        for (int c = 0; c < (dimension == 0 ? 3 : 6); ++c) text >> x;
        text >> count;
        for (int g = 0; g < count && text >> value; ++g) groups[{dimension, tag}].push_back(value);
        if (dimension == 0) continue;
        text >> count;
        for (int b = 0; b < count && text >> value; ++b) bounds[{dimension, tag}].push_back(value);
      }
  }
  void read_nodes(std::istream& text) {
    std::size_t blocks, nodes, least, most;
    text >> blocks >> nodes >> least >> most;
    points.resize(most + 1, {NAN, NAN, NAN});
    for (std::size_t b = 0; b < blocks; ++b) {
      std::size_t dimension, tag, parametric, count;
      text >> dimension >> tag >> parametric >> count;
      std::vector<std::size_t> tags(count);
      for (std::size_t& t : tags) text >> t;
      for (const std::size_t t : tags) text >> points.at(t)[0] >> points[t][1] >> points[t][2];
    }
  }
  void read_elements(std::istream& text) {
    std::size_t blocks, count, least, most;
    text >> blocks >> count >> least >> most;
    std::size_t seen = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      int dimension, tag, kind;
      std::size_t in_block, number;
      text >> dimension >> tag >> kind >> in_block;
      REQUIRE(kind == dimension);  // lines are 1, triangles 2
      for (std::size_t k = 0; k < in_block; ++k) {
        std::vector<int> corners(static_cast<std::size_t>(dimension) + 1);
        text >> number;
        for (int& c : corners) text >> c;
        elements[{dimension, tag}].push_back(corners);
      }
      seen += in_block;
    }
    CHECK(seen == count);
    std::string word;
    text >> word;
    CHECK(word == "$EndElements");
  }
};

}  // namespace

TEST_CASE("STL: a closed solid for each cell, with its volume") {
  TemporaryFolder folder;
  for (RealDiagram& real : volume_cases()) {
    if (real.name == "single precision" || real.name == "box far from the origin")
      continue;  // digits of volumes
    CAPTURE(real.name);
    const io::DiagramOutput output = real.output();
    io::write_output(folder.file("d.stl"), output);
    check_bodies(bodies_of_stl(folder.file("d.stl")), output.measures);
  }
}

TEST_CASE("Gmsh: volumes between triangulated walls") {
  TemporaryFolder folder;
  for (RealDiagram& real : volume_cases()) {
    if (real.name == "single precision" || real.name == "box far from the origin") continue;
    CAPTURE(real.name);
    const io::DiagramOutput output = real.output();
    io::write_output(folder.file("d.msh"), output);
    const Msh msh(folder.file("d.msh"));
    std::map<std::uint32_t, Body> bodies;
    std::map<int, int> sides;
    for (const auto& [entity, surfaces] : msh.bounds) {
      if (entity.first != 3) continue;
      const auto seed = static_cast<std::uint32_t>(entity.second - 1);
      CHECK(msh.names.at({3, msh.groups.at(entity).at(0)}) == "cell_" + std::to_string(seed));
      for (const int surface : surfaces) {
        ++sides[std::abs(surface)];
        for (const auto& t : msh.elements.at({2, std::abs(surface)})) {
          const auto p = [&](int k) {
            return msh.points.at(static_cast<std::size_t>(t[static_cast<std::size_t>(k)]));
          };
          surface > 0 ? bodies[seed].add(p(0), p(1), p(2)) : bodies[seed].add(p(0), p(2), p(1));
        }
      }
    }
    check_bodies(bodies, output.measures);
    for (const auto& [surface, count] : sides) {
      const bool wall = msh.names.at({2, msh.groups.at({2, surface}).at(0)}) == "walls";
      CHECK(count == (wall ? 2 : 1));
    }
    const io::MeshFile mesh = io::parse_gmsh(read_all(folder.file("d.msh")), "d.msh");
    CHECK(mesh.vertex_count() + 1 == msh.points.size());
  }
}

TEST_CASE("Gmsh: cells of polygons and surfaces as triangles") {
  TemporaryFolder folder;
  for (RealDiagram& real : flat_cases()) {
    CAPTURE(real.name);
    const io::DiagramOutput output = real.output();
    io::write_output(folder.file("d.msh"), output);
    const Msh msh(folder.file("d.msh"));
    std::map<std::pair<int, int>, int> edges;  // forth less back
    double lines = 0, walls = 0;
    for (std::uint32_t i = 0; i < output.measures.mass.size(); ++i) {
      const auto found = msh.elements.find({2, static_cast<int>(i) + 1});
      double area = 0;
      if (found != msh.elements.end())
        for (const auto& t : found->second) {
          std::vector<Point> corners;
          for (std::size_t k = 0; k < 3; ++k) {
            corners.push_back(msh.points.at(static_cast<std::size_t>(t[k])));
            ++edges[{t[k], t[(k + 1) % 3]}];
            --edges[{t[(k + 1) % 3], t[k]}];
          }
          area += test::area(corners);
        }
      CHECK(area == doctest::Approx(output.measures.mass[i]).epsilon(1e-9));
    }
    for (const auto& [entity, elements] : msh.elements) {
      if (entity.first != 1) continue;
      const std::string name = msh.names.at({1, msh.groups.at(entity).at(0)});
      for (const auto& line : elements) {
        const Point along = msh.points.at(static_cast<std::size_t>(line[1])) -
                            msh.points.at(static_cast<std::size_t>(line[0]));
        if (name == "walls") lines += std::sqrt(dot(along, along));
        if (output.domain.kind() == DomainKind::polygon)
          CHECK((edges[{line[0], line[1]}] != 0) == (name != "walls"));  // only the boundary is open
      }
    }
    for (const double wall : output.adjacency.wall) walls += wall / 2;
    CHECK(lines == doctest::Approx(walls).epsilon(1e-9));
  }
}
