// Neper's tessellation, read back: its numbers refer to each other as neper's documentation says.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "apps/io/read/domain.hpp"
#include "apps/io/write/output.hpp"
#include "tests/writers/clip_pieces.hpp"
#include "tests/writers/real_diagram.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// A part of the domain: corners, edges around it, and what of the tessellation lies in it.
struct Part {
  std::vector<int> vertices, edges, inside;
  std::string label;
  std::vector<double> plane;
};

struct Face {
  std::vector<int> vertices, edges;
  double plane[4];
};

/// All numbers from 1, as in the file.
struct TessFile {
  int dimension = 0;
  std::vector<int> ids;
  std::vector<std::array<double, 4>> seeds;
  std::vector<Point> vertices{1};
  std::vector<std::array<int, 2>> edges{1};
  std::vector<Face> faces{1};
  std::vector<std::vector<int>> polyhedra{1};
  std::string domain;
  std::vector<Part> domain_vertices{1}, domain_edges{1}, domain_faces{1};

  explicit TessFile(const std::string& path) : text_(read_all(path)) {
    expect("***tess **format 3.4 **general");
    dimension = number<int>();
    expect("standard **cell");
    ids.resize(number<std::size_t>());
    expect("*id");
    for (int& id : ids) id = number<int>();
    expect("*seed");
    for (std::size_t k = 1; k <= ids.size(); ++k) {
      REQUIRE(number<std::size_t>() == k);
      auto& seed = seeds.emplace_back();
      for (double& x : seed) x = number<double>();
    }
    read_geometry();
    read_domain();
    expect("***end");
  }

 private:
  void expect(const std::string& words) {
    std::istringstream expected(words);
    for (std::string word, found; expected >> word;) {
      text_ >> found;
      REQUIRE(found == word);
    }
  }
  template <class T>
  T number() {
    T value{};
    text_ >> value;
    REQUIRE(!text_.fail());
    return value;
  }
  std::vector<int> list() {
    std::vector<int> values(number<std::size_t>());
    for (int& value : values) value = number<int>();
    return values;
  }
  template <class Read>
  void section(const std::string& name, Read read) {
    expect(name);
    const int count = number<int>();
    for (int k = 1; k <= count; ++k) {
      REQUIRE(number<int>() == k);
      read();
    }
  }
  void read_geometry() {
    section("**vertex", [&] {
      Point& x = vertices.emplace_back();
      for (double& c : x) c = number<double>();
      CHECK(number<int>() == 0);
    });
    section("**edge", [&] {
      auto& edge = edges.emplace_back();
      for (int& v : edge) v = number<int>();
      CHECK(number<int>() == 0);
    });
    section("**face", [&] {
      Face& face = faces.emplace_back();
      face.vertices = list();
      face.edges = list();
      for (double& x : face.plane) x = number<double>();
      for (int k = 0; k < 5; ++k) CHECK(number<double>() == 0);
    });
    if (dimension == 3) section("**polyhedron", [&] { polyhedra.push_back(list()); });
  }
  void read_domain() {
    expect("**domain *general");
    text_ >> domain;
    section("*vertex", [&] {
      Part& part = domain_vertices.emplace_back();
      const Point x{number<double>(), number<double>(), number<double>()};
      text_ >> part.label;
      part.inside = list();
      REQUIRE(part.inside.size() == 1);
      CHECK(vertices.at(static_cast<std::size_t>(part.inside[0])) == x);
    });
    section("*edge", [&] {
      Part& part = domain_edges.emplace_back();
      part.vertices = list();
      text_ >> part.label;
      part.inside = list();
    });
    if (dimension == 3)
      section("*face", [&] {
        Part& part = domain_faces.emplace_back();
        part.vertices = list();
        part.edges = list();
        expect("plane 4");
        for (int k = 0; k < 4; ++k) part.plane.push_back(number<double>());
        text_ >> part.label;
        part.inside = list();
      });
  }

  std::istringstream text_;
};

const Point& vertex(const TessFile& file, int v) {
  return file.vertices.at(static_cast<std::size_t>(v));
}

/// Twice the area as a vector.
Point turn(const TessFile& file, const Face& face) {
  Point sum{};
  for (std::size_t k = 2; k < face.vertices.size(); ++k)
    sum = sum + cross(vertex(file, face.vertices[k - 1]) - vertex(file, face.vertices[0]),
                      vertex(file, face.vertices[k]) - vertex(file, face.vertices[0]));
  return sum;
}

double length(const TessFile& file, int edge) {
  const auto& ends = file.edges.at(static_cast<std::size_t>(edge));
  const Point along = vertex(file, ends[1]) - vertex(file, ends[0]);
  return std::sqrt(dot(along, along));
}

/// Edges of a face follow its vertices; its plane contains them and looks to where they turn left.
void check_faces(const TessFile& file) {
  for (std::size_t f = 1; f < file.faces.size(); ++f) {
    const Face& face = file.faces[f];
    REQUIRE(face.vertices.size() == face.edges.size());
    for (std::size_t k = 0; k < face.edges.size(); ++k) {
      const auto& edge = file.edges.at(static_cast<std::size_t>(std::abs(face.edges[k])));
      const bool back = face.edges[k] < 0;
      CHECK(edge[back ? 1 : 0] == face.vertices[k]);
      CHECK(edge[back ? 0 : 1] == face.vertices[(k + 1) % face.vertices.size()]);
      const Point normal{face.plane[1], face.plane[2], face.plane[3]};
      CHECK(dot(normal, vertex(file, face.vertices[k])) == doctest::Approx(face.plane[0]).epsilon(1e-7));
    }
    CHECK(dot({face.plane[1], face.plane[2], face.plane[3]}, turn(file, face)) > 0);
  }
}

void check_cells(const TessFile& file, const Measures& measures) {
  CHECK(file.ids.size() == measures.count(SeedStatus::ok));
  std::map<int, int> sides;
  for (std::size_t k = 0; k < file.ids.size(); ++k) {
    double measure = 0;
    if (file.dimension == 2) {
      measure = turn(file, file.faces.at(k + 1))[2] / 2;
    } else {
      for (const int f : file.polyhedra.at(k + 1)) {
        ++sides[std::abs(f)];
        const Face& face = file.faces.at(static_cast<std::size_t>(std::abs(f)));
        measure += (f < 0 ? -1 : 1) * dot(vertex(file, face.vertices[0]), turn(file, face)) / 6;
      }
    }
    CHECK(measure == doctest::Approx(measures.mass[static_cast<std::size_t>(file.ids[k] - 1)]).epsilon(1e-7));
  }
  std::set<int> at_boundary;
  for (const Part& part : file.domain_faces) at_boundary.insert(part.inside.begin(), part.inside.end());
  for (const auto& [face, count] : sides) CHECK(count == (at_boundary.count(face) == 1 ? 1 : 2));
}

/// Neper computes |x - p|^2 - r^2: differences of squared radii are those of the weights.
void check_seeds(const TessFile& file, const io::DiagramOutput& output) {
  const auto d = static_cast<std::size_t>(output.seeds.dimension);
  for (std::size_t k = 0; k < file.ids.size(); ++k) {
    const auto i = static_cast<std::size_t>(file.ids[k] - 1),
               first = static_cast<std::size_t>(file.ids[0] - 1);
    for (std::size_t c = 0; c < d; ++c) CHECK(file.seeds[k][c] == output.seeds.positions[i * d + c]);
    const double squares = file.seeds[k][3] * file.seeds[k][3] - file.seeds[0][3] * file.seeds[0][3];
    CHECK(squares == doctest::Approx(output.seeds.weights[i] - output.seeds.weights[first]).epsilon(1e-9));
  }
}

}  // namespace

TEST_CASE("neper: a box in space") {
  TemporaryFolder folder;
  for (const bool lattice : {false, true}) {
    const Domain cube = io::read_domain("cube").domain;
    RealDiagram real =
        lattice ? real_diagram("lattice", cube, lattice_points(3, 3)) : random_diagram("box", cube, 150);
    io::write_output(folder.file("d.tess"), real.output());
    const TessFile file(folder.file("d.tess"));
    check_faces(file);
    check_cells(file, real.output().measures);
    check_seeds(file, real.output());
    CHECK(file.domain == "cube");
    REQUIRE(file.domain_vertices.size() == 9);
    REQUIRE(file.domain_edges.size() == 13);
    REQUIRE(file.domain_faces.size() == 7);
    std::set<std::string> labels;
    for (std::size_t f = 1; f < 7; ++f) {
      const Part& part = file.domain_faces[f];
      double area = 0;
      for (const int inside : part.inside) {
        const Point twice = turn(file, file.faces.at(static_cast<std::size_t>(inside)));
        area += std::sqrt(dot(twice, twice)) / 2;
      }
      CHECK(area == doctest::Approx(1).epsilon(1e-9));
      REQUIRE(part.vertices.size() == 4);
      REQUIRE(part.edges.size() == 4);
      const std::size_t axis = static_cast<std::size_t>(part.label[0] - 'x');
      for (std::size_t k = 0; k < 4; ++k) {
        const Part& corner = file.domain_vertices.at(static_cast<std::size_t>(part.vertices[k]));
        CHECK(vertex(file, corner.inside[0])[axis] == part.label[1] - '0');
        std::set<int> ends{part.vertices[k], part.vertices[(k + 1) % 4]};
        const Part& edge = file.domain_edges.at(static_cast<std::size_t>(part.edges[k]));
        CHECK(std::set<int>(edge.vertices.begin(), edge.vertices.end()) == ends);
        CHECK(edge.label.find(part.label) != std::string::npos);
      }
      CHECK(part.plane[axis + 1] == (part.label[1] == '0' ? 1 : -1));  // inwards
      labels.insert(part.label);
    }
    CHECK(labels == std::set<std::string>{"x0", "x1", "y0", "y1", "z0", "z1"});
    for (std::size_t e = 1; e < 13; ++e) {
      double sum = 0;
      for (const int edge : file.domain_edges[e].inside) sum += length(file, edge);
      CHECK(sum == doctest::Approx(1).epsilon(1e-12));
    }
    for (std::size_t v = 1; v < 9; ++v) {
      const Point& x = vertex(file, file.domain_vertices[v].inside[0]);
      std::string label;
      for (std::size_t k = 0; k < 3; ++k) label += std::string(1, "xyz"[k]) + (x[k] > 0.5 ? "1" : "0");
      CHECK(file.domain_vertices[v].label == label);
    }
  }
}

TEST_CASE("neper: meshes and solids") {
  TemporaryFolder folder;
  for (RealDiagram& real : volume_cases()) {
    if (real.name == "single precision" || real.name == "box far from the origin") continue;
    CAPTURE(real.name);
    io::write_output(folder.file("d.tess"), real.output());
    const TessFile file(folder.file("d.tess"));
    check_faces(file);
    check_cells(file, real.output().measures);
    // Each edge of the domain is between two of its vertices, and all that lies in it sums to that.
    for (std::size_t e = 1; e < file.domain_edges.size(); ++e) {
      double sum = 0;
      for (const int edge : file.domain_edges[e].inside) sum += length(file, edge);
      const auto end = [&](std::size_t k) {
        const auto v = static_cast<std::size_t>(file.domain_edges[e].vertices.at(k));
        return vertex(file, file.domain_vertices.at(v).inside[0]);
      };
      const Point along = end(1) - end(0);
      CHECK(sum == doctest::Approx(std::sqrt(dot(along, along))).epsilon(1e-9));
    }
  }
}

TEST_CASE("neper: the plane") {
  TemporaryFolder folder;
  for (const std::string spec : {"square", "disk:7"}) {
    RealDiagram real = random_diagram(spec, io::read_domain(spec).domain, 80);
    const io::DiagramOutput output = real.output();
    io::write_output(folder.file("d.tess"), output);
    const TessFile file(folder.file("d.tess"));
    CHECK(file.dimension == 2);
    check_faces(file);
    check_cells(file, output.measures);
    check_seeds(file, output);
    CHECK(file.domain == (spec == "square" ? "cube" : "poly"));
    const std::size_t sides = spec == "square" ? 4 : 7;
    CHECK(file.domain_vertices.size() == sides + 1);
    CHECK(file.domain_edges.size() == sides + 1);
    for (std::size_t e = 1; e < file.domain_edges.size(); ++e) {
      double sum = 0;
      for (const int edge : file.domain_edges[e].inside) sum += length(file, edge);
      CHECK(sum == doctest::Approx(sides == 4 ? 1 : 2 * std::sin(3.14159265358979324 / 7)).epsilon(1e-9));
      if (sides != 4) continue;
      const std::string& label = file.domain_edges[e].label;
      for (const int v : file.domain_edges[e].vertices) {
        const auto at = static_cast<std::size_t>(v);
        CHECK(vertex(file, file.domain_vertices.at(at).inside[0])[label[0] == 'x' ? 0 : 1] == label[1] - '0');
      }
    }
  }
}

TEST_CASE("neper: what its cells cannot be is refused") {
  TemporaryFolder folder;
  RealDiagram hole = real_diagram("hole", square_with_hole(), {0.4, 0.4});
  CHECK_THROWS_WITH_AS(io::write_output(folder.file("d.tess"), hole.output()),
                       doctest::Contains("the cell of seed 0 has a hole"), Error);
  const double low[] = {0, 0}, high[] = {1, 1};
  CHECK_THROWS_WITH_AS(io::check_output("d.tess", Domain::periodic_box(low, high), 5),
                       doctest::Contains("bounded"), Error);
  CHECK_THROWS_WITH_AS(io::check_output("d.tess", io::read_domain("sphere:4").domain, 5),
                       doctest::Contains(".msh"), Error);
  CHECK_THROWS_WITH_AS(io::check_output("d.stl", hole.diagram->domain(), 5), doctest::Contains(".obj"),
                       Error);
  CHECK(folder.count() == 0);
}
