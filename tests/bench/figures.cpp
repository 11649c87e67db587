// The figures of a record as CSV and as a picture.
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "apps/bench/csv.hpp"
#include "apps/bench/plot.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::app;

namespace {

BenchRecord two_devices() {
  BenchRecord record;
  for (const int device : {0, 1}) {
    BenchDevice measured;
    measured.info.name = device == 0 ? "one, \"<two>\"" : "other";
    measured.info.device = device;
    measured.latencies = {1e-6, 2e-6, 0.25, 0.5};
    measured.rates = {{"double", {1e10, 2e10, 0.125, 0}}};
    measured.transfers = {{4096, {1e8, 2e8, 0, 0.5}}, {16384, {4e8, 5e8, 0, 0.5}}};
    BenchRow row;
    row.device = measured.info.name;
    row.selector = measured.info.selector();
    row.domain = "cube";
    row.precision = "double";
    row.n = 1000;
    row.measures.seconds = {0.5, 0.625, 0.75};
    row.adjacency.seconds = {1};
    record.devices.push_back(measured);
    record.rows.push_back(row);
  }
  record.rows.push_back(record.rows.back());
  record.rows.back().failure = "out of memory";
  return record;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("the table has a row for each figure, with its scatter") {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() / "a.csv";
  write_csv(path, two_devices());
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  const std::string start = "\n0:0,\"one, \"\"<two>\"\"\",";
  CHECK(text.str().find("device,name,figure,domain,precision,size,value,unit,scatter,runs\n") == 0);
  for (const char* row :
       {"launch,,,,1e-06,s,0.25,\n", "transfer,,,,2e-06,s,0.5,\n", "copied,,double,,1e+10,bytes/s,0.125,\n",
        "operations,,double,,2e+10,operations/s,0,\n", "to_device,,,4096,1e+08,bytes/s,0,\n",
        "to_host,,,16384,5e+08,bytes/s,0.5,\n", "measures,cube,double,1000,2000,cells/s,0.25,3\n",
        "adjacency,cube,double,1000,1000,cells/s,0,1\n"})
    CHECK_MESSAGE(text.str().find(start + row) != std::string::npos, row);
  CHECK(count(text.str(), "\n") == 1 + 2 * 10);
}

TEST_CASE("the plot has a dot for each figure, at the same place for the same rate") {
  const std::string svg = plot_svg(two_devices());
  CHECK(svg.find("<?xml") == 0);
  CHECK(count(svg, "<circle") == 2 * (1 + 2 + 4));  // in the list of devices, of rows, of transfers
  CHECK(svg.find("one, &quot;&lt;two&gt;&quot;; double: 20 Gflop/s ±0 %, 10 GB/s ±12 %") !=
        std::string::npos);
  CHECK(svg.find("cube, double, 1,000<") != std::string::npos);
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf\"") == std::string::npos);
  const std::string empty = plot_svg({});  // every row failed on a device that cannot be opened
  CHECK(count(empty, "<circle") == 0);
  CHECK(empty.find("</svg>") != std::string::npos);
}
