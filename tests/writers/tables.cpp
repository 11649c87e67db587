#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "apps/io/names.hpp"
#include "apps/io/write/table.hpp"
#include "tests/writers/made_diagram.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::vector<std::vector<std::string>> rows(const std::string& path) {
  std::vector<std::vector<std::string>> result;
  for (const std::string& line : split(read_all(path), '\n')) result.push_back(split(line, ','));
  REQUIRE(result.back() == std::vector<std::string>{""});  // the last line ends with a newline
  result.pop_back();
  return result;
}

}  // namespace

TEST_CASE("the table has a row for each seed and its numbers read back the same") {
  TemporaryFolder folder;
  for (const MadeDiagram& made : {polygon_diagram(60), volume_diagram(20)}) {
    const std::string path = folder.file("table.csv");
    const SeedsView seeds = made.output().seeds;
    io::write_table(path, seeds, made.measures, made.adjacency);
    const auto table = rows(path);
    const auto d = static_cast<std::size_t>(seeds.dimension);
    REQUIRE(table.size() == seeds.size() + 1);
    CHECK(table[0].size() == 2 * d + 6);
    CHECK(table[0][d + 1] == "weight");
    CHECK(table[0].back() == "neighbors");
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const auto& row = table[i + 1];
      CAPTURE(i);
      REQUIRE(row.size() == table[0].size());
      CHECK(row[0] == std::to_string(i));
      for (std::size_t k = 0; k < d; ++k) CHECK(std::stod(row[1 + k]) == seeds.positions[i * d + k]);
      CHECK(std::stod(row[1 + d]) == seeds.weights[i]);
      CHECK(row[2 + d] == io::name(made.measures.status[i]));
      CHECK(std::stod(row[3 + d]) == made.measures.mass[i]);
      for (std::size_t k = 0; k < d; ++k) {
        if (made.measures.mass[i] > 0)
          CHECK(std::stod(row[4 + d + k]) == made.measures.centroid[i * d + k]);
        else
          CHECK(row[4 + d + k].empty());
      }
      CHECK(std::stod(row[4 + 2 * d]) == made.measures.second_moment[i]);
      CHECK(std::stoull(row[5 + 2 * d]) == made.adjacency.offset[i + 1] - made.adjacency.offset[i]);
    }
  }
}

TEST_CASE("hidden and duplicate seeds are distinguished") {
  TemporaryFolder folder;
  const MadeDiagram made = polygon_diagram(60);
  io::write_table(folder.file("t.csv"), made.output().seeds, made.measures, made.adjacency);
  std::map<std::string, std::size_t> count;
  for (const auto& row : rows(folder.file("t.csv"))) ++count[row[4]];
  CHECK(count["ok"] == made.measures.count(SeedStatus::ok));
  CHECK(count["hidden"] > 0);
  CHECK(count["duplicate"] == 1);
}

TEST_CASE("walls are written in both directions with the same measure") {
  TemporaryFolder folder;
  const MadeDiagram made = polygon_diagram(60);
  io::write_walls(folder.file("walls.csv"), made.adjacency);
  const auto table = rows(folder.file("walls.csv"));
  REQUIRE(table.size() == made.adjacency.neighbor.size() + 1);
  CHECK(table[0] == std::vector<std::string>{"seed", "neighbor", "measure"});
  std::map<std::pair<int, int>, double> wall;
  for (std::size_t r = 1; r < table.size(); ++r) {
    wall[{std::stoi(table[r][0]), std::stoi(table[r][1])}] = std::stod(table[r][2]);
  }
  for (const auto& [pair, length] : wall) {
    REQUIRE(wall.count({pair.second, pair.first}) == 1);
    CHECK(wall.at({pair.second, pair.first}) == doctest::Approx(length).epsilon(1e-9));
  }
}

TEST_CASE("without seeds a table has only its header") {
  TemporaryFolder folder;
  Measures measures;
  measures.dimension = 2;
  io::write_table(folder.file("t.csv"), {2, {}, {}}, measures, {});
  io::write_walls(folder.file("w.csv"), {});
  CHECK(rows(folder.file("t.csv")).size() == 1);
  CHECK(rows(folder.file("w.csv")).size() == 1);
}

TEST_CASE("seeds without weights have weight 0") {
  TemporaryFolder folder;
  MadeDiagram made = polygon_diagram(5);
  SeedsView seeds = made.output().seeds;
  seeds.weights = {};
  io::write_table(folder.file("t.csv"), seeds, made.measures, made.adjacency);
  CHECK(rows(folder.file("t.csv"))[3][3] == "0");
}
