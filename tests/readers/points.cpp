// Seeds as people have them: decimal commas, columns of well-known text, points in GeoJSON and GeoPackages.
#include <doctest/doctest.h>
#include <sqlite3.h>

#include <cstring>
#include <filesystem>

#include "apps/io/read/domain.hpp"
#include "apps/io/tables/feature_rows.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {

using Numbers = std::vector<double>;

SeedTable table(const std::string& text, int dimension = 2, const ColumnChoice& choice = {}) {
  return parse_seeds_text(text, dimension, "s.csv", choice);
}

/// A GeoPackage in a temporary folder, made by SQL.
class GeoPackageFile {
 public:
  explicit GeoPackageFile(const std::string& sql)
      : path_((std::filesystem::temp_directory_path() / "powercell_points.gpkg").string()) {
    std::filesystem::remove(path_);
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(path_.c_str(), &database) == SQLITE_OK);
    const std::string tables =
        "CREATE TABLE gpkg_spatial_ref_sys (srs_name, srs_id, organization, organization_coordsys_id, "
        "definition);"
        "INSERT INTO gpkg_spatial_ref_sys VALUES ('utm', 7, 'EPSG', 32633, 'x'), ('none', -1, 'NONE', -1, "
        "'x');"
        "CREATE TABLE gpkg_geometry_columns (table_name, column_name, geometry_type_name, srs_id, z, m);";
    REQUIRE(sqlite3_exec(database, (tables + sql).c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(database);
  }
  ~GeoPackageFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string hex(const void* data, std::size_t size) {
  std::string text;
  for (std::size_t k = 0; k < size; ++k) {
    constexpr const char* digits = "0123456789ABCDEF";
    const unsigned byte = static_cast<const unsigned char*>(data)[k];
    text += digits[byte / 16];
    text += digits[byte % 16];
  }
  return text;
}

/// The blob of a point as an SQL literal, with an envelope of 32 bytes or without.
std::string point_blob(double x, double y, bool envelope) {
  std::string text = envelope ? "X'47500003" : "X'47500001";
  text += "07000000";
  const double box[] = {x, x, y, y};
  if (envelope) text += hex(box, sizeof box);
  const double point[] = {x, y};
  return text + "0101000000" + hex(point, sizeof point) + "'";
}

std::string square_blob(double size) {
  const double ring[] = {0, 0, size, 0, size, size, 0, size, 0, 0};
  return "X'4750000107000000"
         "0103000000"
         "01000000"
         "05000000" +
         hex(ring, sizeof ring) + "'";
}

}  // namespace

TEST_CASE("decimal commas are read where semicolons or tabs separate columns") {
  for (const char* text :
       {"x;y;w\n0,25;0,5;3\n1;-2;4,5\n", "0,25\t,5\t3\n1\t-2\t4,5\n", "0,25;5e-1;3\n1;-2;+4,5\n"}) {
    CAPTURE(text);
    const SeedTable seeds = table(text);
    CHECK(seeds.positions == Numbers{0.25, 0.5, 1, -2});
    CHECK(seeds.weights == Numbers{3, 4.5});
    CHECK(says(seeds.columns.note, "decimal commas"));
    CHECK(seeds.text.mark == ',');
  }
  const auto message = [](const std::string& text) { return refusal([&] { table(text); }); };
  CHECK(says(message("0,5;0.5\n"),
             "s.csv:1: seed 0 (from 0), column 2: '0.5' has a decimal point, but numbers before"));
  CHECK(says(message("0.5;0,5\n"),
             "column 2: '0,5' has a decimal comma, but numbers before have decimal points"));
  CHECK(says(message("1.234,5;2\n"), "'1.234,5' is not a number"));
  CHECK(says(message("1 2\n0,5 2\n"),
             "'0,5' is not a number: decimal commas are not read, write a point, or separate"));
  // A label such as a list says nothing of the numbers.
  CHECK(table("x;y;parts\n0.5;0.5;1,2\n").positions == Numbers{0.5, 0.5});
}

TEST_CASE("points in a column of well-known text are the seeds") {
  const SeedTable seeds =
      table("name,geom,w\nA,POINT (0.25 0.5),3\nB,\"Point Z(1 -2 7)\",4\nC,MULTIPOINT ((5 6)),0\n");
  CHECK(seeds.positions == Numbers{0.25, 0.5, 1, -2, 5, 6});
  CHECK(seeds.weights == Numbers{3, 4, 0});
  CHECK(seeds.columns.names == std::vector<std::string>{"x", "y", "name", "geom", "w"});
  CHECK(seeds.text.field(1, 2) == "B");
  CHECK(seeds.columns.note ==
        "seeds: positions from the points of 'geom', weight from 'w'; kept: 'name', 'geom'");
  CHECK(table("POINT (1 2)\nPOINT(3 4)\n").positions == Numbers{1, 2, 3, 4});
  CHECK(table("id\twkt\n7\tSRID=32633;POINT (1 2)\n").columns.crs == "EPSG:32633");
  CHECK(table("id,wkt\n7,POINT Z (1 2 3)\n", 3).positions == Numbers{1, 2, 3});
  // Columns named x and y, or chosen, are taken before points.
  CHECK(table("x,y,geom\n8,9,POINT (1 2)\n").positions == Numbers{8, 9});
  ColumnChoice choice;
  choice.position = {"a", "b", ""};
  CHECK(table("a,b,geom\n8,9,POINT (1 2)\n", 2, choice).positions == Numbers{8, 9});

  const auto message = [](const std::string& text, int d = 2) { return refusal([&] { table(text, d); }); };
  CHECK(says(message("id,geom\n1,POINT (1 2)\n2,POINT EMPTY\n"),
             "s.csv:3: 'POINT EMPTY' is an empty geometry"));
  CHECK(says(message("id;geom\n1;POINT (1 2)\n2;LINESTRING (0 0, 1 1)\n"),
             "s.csv:3: 'LINESTRING (0 0, 1 1)' is not a point"));
  CHECK(says(message("id\tgeom\n1\tSRID=4326;POINT (1 2)\n2\tPOINT (1 2)\n"),
             "s.csv:3: the point is in '', the ones before in 'EPSG:4326'"));
  CHECK(says(message("id,geom\n1,POINT (1 2)\n", 3), "column 3: 'nan' is not a finite number"));
  CHECK(says(message("id,geom\n1,POINT (1 2\n"), "s.csv:2: 'POINT (1 2' is not well-known text"));
}

TEST_CASE("points in GeoJSON are seeds with their properties") {
  const auto read = [](const std::string& text, int dimension) {
    FeatureRows rows = parse_geojson_points(text, static_cast<std::size_t>(dimension), "p.geojson");
    return parse_seed_rows(rows, dimension, {});
  };
  const std::string features = R"({"type":"FeatureCollection","features":[
    {"type":"Feature","id":12,"properties":{"name":"A, \"old\"","weight":3,"open":true,"x":"west"},
     "geometry":{"type":"Point","coordinates":[0.25,0.5,9]}},
    {"type":"Feature","properties":{"turnover":1e3,"weight":4,"name":null},
     "geometry":{"type":"MultiPoint","coordinates":[[0.1,-2]]}}]})";
  const SeedTable seeds = read(features, 2);
  CHECK(seeds.positions == Numbers{0.25, 0.5, 0.1, -2});
  CHECK(seeds.weights == Numbers{3, 4});
  CHECK(seeds.columns.names ==
        std::vector<std::string>{"x", "y", "id", "name", "weight", "open", "input_x", "turnover"});
  CHECK(seeds.text.field(0, 3) == "A, \"old\"");
  CHECK(seeds.text.field(0, 5) == "true");
  CHECK(seeds.text.field(1, 3).empty());
  CHECK(seeds.text.field(1, 7) == "1000.0");
  CHECK(says(refusal([&] { read(features, 3); }), "p.geojson: feature 1 (from 0): its z is missing"));
  CHECK(read(R"({"type":"Point","coordinates":[1,2,3]})", 3).positions == Numbers{1, 2, 3});

  const auto message = [&](const std::string& geometry, const std::string& properties = "{}") {
    return refusal([&] {
      read(R"({"type":"Feature","properties":)" + properties + ",\"geometry\":" + geometry + "}", 2);
    });
  };
  CHECK(says(message(R"({"type":"Polygon","coordinates":[]})"),
             "p.geojson: $.geometry is a Polygon; seeds are points"));
  CHECK(says(message(R"({"type":"MultiPoint","coordinates":[[0,0],[1,1]]})"), "has 2 points; split it"));
  CHECK(says(message("null"), "p.geojson: $ has no point; remove it"));
  CHECK(says(message(R"({"type":"Point","coordinates":[0,"a"]})"), "$.geometry.coordinates is not a point"));
  CHECK(says(message(R"({"type":"Point","coordinates":[0,1]})", R"({"weight":"big"})"),
             "p.geojson: feature 0 (from 0): seed 0 (from 0), 'weight': 'big' is not a number"));
}

TEST_CASE("a GeoPackage has seeds and domains") {
  const GeoPackageFile file(
      "CREATE TABLE shops (fid INTEGER PRIMARY KEY, geom BLOB, name TEXT, w REAL);"
      "INSERT INTO shops VALUES (1, " +
      point_blob(0.25, 0.5, false) + ", 'A', 0.1), (2, " + point_blob(1, -2, true) +
      ", NULL, 4);"
      "INSERT INTO gpkg_geometry_columns VALUES ('shops', 'geom', 'POINT', 7, 0, 0), "
      "('land', 'shape', 'POLYGON', 7, 0, 0), ('more', 'shape', 'MULTIPOLYGON', -1, 0, 0);"
      "CREATE TABLE land (fid INTEGER PRIMARY KEY, shape BLOB); INSERT INTO land VALUES (1, " +
      square_blob(4) +
      ");"
      "CREATE TABLE more (fid INTEGER PRIMARY KEY, shape BLOB); INSERT INTO more VALUES (1, " +
      square_blob(2) + "), (2, NULL);");
  const SeedTable seeds = read_seed_file(file.path(), 2, {});
  CHECK(seeds.positions == Numbers{0.25, 0.5, 1, -2});
  CHECK(seeds.weights == Numbers{0.1, 4});
  CHECK(seeds.columns.names == std::vector<std::string>{"x", "y", "fid", "name", "w"});
  CHECK(seeds.text.field(0, 3) == "A");
  CHECK(seeds.columns.crs == "EPSG:32633");
  CHECK(read_domain(file.path() + ":land").domain.measure() == doctest::Approx(16));
  CHECK(read_domain(file.path() + ":land").crs.name == "EPSG:32633");
  CHECK(read_domain(file.path() + ":more").domain.measure() == doctest::Approx(4));
  CHECK(read_domain(file.path() + ":more").crs.name.empty());
  CHECK(says(refusal([&] { read_domain(file.path()); }),
             "has 2 layers of polygons; it has shops (point), land (polygon)"));
  CHECK(says(refusal([&] { read_domain(file.path() + ":sea"); }), "has no layer of that name; it has shops"));
  CHECK(says(refusal([&] { read_domain(file.path() + ":shops"); }), "feature 0 (from 0): is not a polygon"));
  CHECK(says(refusal([&] { read_seed_file("missing.gpkg", 2, {}); }), "missing.gpkg"));
}
