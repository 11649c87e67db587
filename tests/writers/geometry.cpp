// Measures recomputed from the written files equal those of the cells.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>

#include "apps/io/write/output.hpp"
#include "tests/writers/clip_pieces.hpp"
#include "tests/writers/made_diagram.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

// For each seed the area of its polygons, and the volume inside them (by the divergence theorem).
struct Sums {
  std::map<int, double> area, volume;
  void add(int seed, const std::vector<Point>& polygon) {
    area[seed] += test::area(polygon);
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      volume[seed] += dot(polygon[0], cross(polygon[k], polygon[k + 1])) / 6;
    }
  }
  void check(const MadeDiagram& made) const {
    const bool solid = made.domain.cell_dimension() == 3;
    for (std::size_t i = 0; i < made.weights.size(); ++i) {
      CAPTURE(i);
      const auto& found = solid ? volume : area;
      const auto at = found.find(static_cast<int>(i));
      const double measure = at == found.end() ? 0.0 : at->second;
      CHECK(measure == doctest::Approx(made.measures.mass[i]).epsilon(1e-9));
    }
  }
};

std::vector<MadeDiagram> diagrams() {
  std::vector<MadeDiagram> result;
  result.push_back(polygon_diagram(60));
  result.push_back(surface_diagram(20));
  result.push_back(volume_diagram(30));
  return result;
}

Sums sums_of_obj(const std::string& path) {
  Sums sums;
  std::istringstream text(read_all(path));
  std::vector<Point> points;
  int seed = -1;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string kind, group;
    words >> kind;
    if (kind == "v") {
      Point& p = points.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    }
    if (kind == "g") {
      words >> group;
      REQUIRE(group.rfind("cell_", 0) == 0);
      seed = std::stoi(group.substr(5));
    }
    if (kind == "f") {
      std::vector<Point> polygon;
      for (std::size_t v; words >> v;) polygon.push_back(points.at(v - 1));
      sums.add(seed, polygon);
    }
  }
  return sums;
}

Sums sums_of_off(const std::string& path) {
  Sums sums;
  std::istringstream text(read_all(path));
  std::string word, line;
  std::size_t vertices, faces, edges;
  text >> word >> vertices >> faces >> edges;
  REQUIRE(word == "OFF");
  std::vector<Point> points(vertices);
  for (Point& p : points) text >> p[0] >> p[1] >> p[2];
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t corners, v;
    int red, green, blue, seed;
    text >> corners;
    std::vector<Point> polygon;
    for (std::size_t k = 0; k < corners && text >> v; ++k) polygon.push_back(points.at(v));
    text >> red >> green >> blue >> word >> seed;
    REQUIRE(text);
    REQUIRE(word == "#");
    CHECK(std::max({red, green, blue}) < 256);
    sums.add(seed, polygon);
  }
  CHECK(!(text >> word));
  return sums;
}

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value;
  REQUIRE(at + sizeof value <= bytes.size());
  std::memcpy(&value, &bytes[at], sizeof value);
  at += sizeof value;
  return value;
}

Sums sums_of_ply(const std::string& path) {
  Sums sums;
  const std::string bytes = read_all(path);
  std::size_t at = bytes.find("end_header\n");
  REQUIRE(at != std::string::npos);
  std::istringstream header(bytes.substr(0, at));
  at += std::strlen("end_header\n");
  std::map<std::string, std::size_t> elements;
  for (std::string word; header >> word;) {
    if (word != "element") continue;
    std::string name;
    header >> name;
    header >> elements[name];
  }
  std::vector<Point> points(elements.at("vertex"));
  for (Point& p : points) {
    for (double& x : p) x = take<double>(bytes, at);
  }
  for (std::size_t f = 0; f < elements.at("face"); ++f) {
    std::vector<Point> polygon(take<std::uint8_t>(bytes, at));
    for (Point& p : polygon) p = points.at(static_cast<std::size_t>(take<std::int32_t>(bytes, at)));
    at += 3;  // colour
    sums.add(take<std::int32_t>(bytes, at), polygon);
  }
  CHECK(at == bytes.size());
  return sums;
}

double signed_area(const std::vector<Point>& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) twice += cross(ring[k], ring[(k + 1) % ring.size()])[2];
  return twice / 2;
}

Sums sums_of_json(const nlohmann::json& json, bool flat) {
  Sums sums;
  for (const auto& cell : json.at("cells")) {
    const int seed = cell.at("seed");
    for (const auto& face : cell.at("faces")) {
      std::vector<Point> polygon;
      for (const std::size_t v : face) {
        const auto& p = cell.at("vertices").at(v);
        polygon.push_back({p[0], p[1], p.size() > 2 ? p[2].get<double>() : 0.0});
      }
      if (flat)
        sums.area[seed] += signed_area(polygon);  // holes run clockwise
      else
        sums.add(seed, polygon);
    }
  }
  return sums;
}

}  // namespace

TEST_CASE("polygon files contain the cells") {
  TemporaryFolder folder;
  for (const MadeDiagram& made : diagrams()) {
    CAPTURE(static_cast<int>(made.domain.kind()));
    for (const std::string name : {"d.obj", "d.off", "d.ply"})
      io::write_output(folder.file(name), made.output());
    sums_of_obj(folder.file("d.obj")).check(made);
    sums_of_off(folder.file("d.off")).check(made);
    sums_of_ply(folder.file("d.ply")).check(made);
  }
}

TEST_CASE("JSON contains the joined cells, their figures and the self-check") {
  TemporaryFolder folder;
  for (const MadeDiagram& made : diagrams()) {
    CAPTURE(static_cast<int>(made.domain.kind()));
    io::write_output(folder.file("d.json"), made.output());
    const auto json = nlohmann::json::parse(read_all(folder.file("d.json")));
    sums_of_json(json, made.domain.kind() == DomainKind::polygon).check(made);
    CHECK(json.at("check").at("cells") == made.measures.count(SeedStatus::ok));
    CHECK(json.at("check").at("hidden") == made.measures.count(SeedStatus::hidden));
    CHECK(json.at("check").at("relative_error").get<double>() == made.measures.relative_error());
    REQUIRE(json.at("cells").size() == made.weights.size());
    for (std::size_t i = 0; i < made.weights.size(); ++i) {
      const auto& cell = json.at("cells")[i];
      CHECK(cell.at("weight").get<double>() == made.weights[i]);
      CHECK(cell.at("measure").get<double>() == made.measures.mass[i]);
      CHECK(cell.at("centroid").is_null() == (made.measures.mass[i] == 0));
      REQUIRE(cell.at("borders").size() == cell.at("faces").size());
    }
  }
}

TEST_CASE("the borders in JSON name the neighbours") {
  TemporaryFolder folder;
  const MadeDiagram made = polygon_diagram(60);
  io::write_output(folder.file("d.json"), made.output());
  const auto json = nlohmann::json::parse(read_all(folder.file("d.json")));
  for (std::size_t i = 0; i < made.weights.size(); ++i) {
    std::map<std::uint32_t, bool> named;
    for (const auto& ring : json.at("cells")[i].at("borders")) {
      for (const auto& border : ring) {
        REQUIRE(border.is_number_integer());  // no edges between pieces of a cell remain
        if (border.get<int>() >= 0) named[border.get<std::uint32_t>()] = true;
      }
    }
    for (const auto& [j, seen] : named) {
      const auto begin =
          made.adjacency.neighbor.begin() + static_cast<std::ptrdiff_t>(made.adjacency.offset[i]);
      const auto end =
          made.adjacency.neighbor.begin() + static_cast<std::ptrdiff_t>(made.adjacency.offset[i + 1]);
      CHECK(std::find(begin, end, j) != end);
    }
  }
}

TEST_CASE("VTK files are XML with the announced counts") {
  TemporaryFolder folder;
  for (const MadeDiagram& made : diagrams()) {
    io::write_output(folder.file("d.vtu"), made.output());
    pugi::xml_document document;
    REQUIRE(document.load_file(folder.file("d.vtu").c_str()));
    const auto piece = document.child("VTKFile").child("UnstructuredGrid").child("Piece");
    CHECK(piece.attribute("NumberOfCells").as_ullong() == made.cells.piece_count());
    CHECK(piece.attribute("NumberOfPoints").as_ullong() < made.cells.vertex_offset.back() / 2);  // shared
    const bool solid = made.domain.cell_dimension() == 3;
    CHECK(!piece.child("Cells").find_child_by_attribute("Name", "faces").empty() == solid);
    for (const char* name : {"seed", "region", "weight", "measure", "piece_measure"}) {
      CHECK(piece.child("CellData").find_child_by_attribute("Name", name));
    }
    io::write_output(folder.file("d.vtp"), made.output());
    REQUIRE(document.load_file(folder.file("d.vtp").c_str()));
    const auto polygons = document.child("VTKFile").child("PolyData").child("Piece");
    CHECK(polygons.attribute("NumberOfPolys").as_ullong() ==
          (solid ? made.joined.loop_offset.size() - 1 : made.cells.piece_count()));
  }
}

TEST_CASE("a diagram without seeds is written in every format") {
  TemporaryFolder folder;
  for (const Domain& domain :
       {polygon_diagram(1).domain, volume_diagram(1).domain, surface_diagram(1).domain}) {
    const MadeDiagram made = make_diagram(domain, {}, {});
    for (const std::string extension :
         {".svg", ".png", ".pdf", ".vtu", ".vtp", ".obj", ".ply", ".off", ".json"}) {
      CAPTURE(extension);
      if (domain.kind() != DomainKind::polygon && (extension == ".svg" || extension == ".pdf")) continue;
      CHECK_NOTHROW(io::write_output(folder.file("d" + extension), made.output()));
      CHECK(std::filesystem::file_size(folder.file("d" + extension)) > 0);
    }
  }
}
