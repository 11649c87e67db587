// Records of the benchmark: written, read back, compared, refused.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "apps/bench/table.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::app;
using nlohmann::json;

namespace {

BenchRow made_row(const std::string& selector, const std::string& precision, std::size_t n, double seconds) {
  BenchRow row;
  row.device = "device of two units";
  row.selector = selector;
  row.domain = "cube";
  row.precision = precision;
  row.n = n;
  row.measures.seconds = {2 * seconds, seconds};
  row.adjacency.seconds = {2 * seconds};
  return row;
}

BenchRecord made_record() {
  BenchRecord record;
  record.revision = "0a1b2c3";
  record.date = "2026-01-02T03:04:05Z";
  record.rows = {made_row("0:0", "double", 1000, 0.1), made_row("0:0", "float", 1000, 0.05),
                 made_row("0:0", "float", 2000, 0.1), made_row("1:0", "double", 1000, 0.2)};
  return record;
}

EarlierRecord read_text(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() / "old.json";
  std::ofstream(path) << text;
  return read_record(path);
}

std::string refusal(const std::function<void(json&)>& spoil) {
  json whole = as_json(made_record());
  spoil(whole);
  try {
    read_text(whole.dump());
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_file);
    return error.what();
  }
  return {};
}

bool says(const std::string& text, const std::string& part) {
  return text.find("old.json: ") != std::string::npos && text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a written record is read back") {
  const EarlierRecord read = read_text(as_json(made_record()).dump());
  CHECK(read.revision == "0a1b2c3");
  CHECK(read.date == "2026-01-02T03:04:05Z");
  CHECK(read.version == version());
  REQUIRE(read.rows.size() == 4);
  CHECK(read.rows[1].precision == "float");
  CHECK(read.rows[1].rate == 20000);
  CHECK(read.rows[1].adjacency_rate == 10000);
}

TEST_CASE("a record without a revision, and rows that failed") {
  BenchRecord record = made_record();
  record.revision = "";
  record.rows[0].failure = "out of memory";
  const EarlierRecord read = read_text(as_json(record).dump());
  CHECK(read.revision == "");
  CHECK(read.rows.size() == 3);
}

TEST_CASE("rows are found by device, domain, precision and seeds") {
  const EarlierRecord read = read_text(as_json(made_record()).dump());
  const std::string name = "device of two units";
  REQUIRE(read.find(name, "0:0", "cube", "float", 2000) != nullptr);
  CHECK(read.find(name, "0:0", "cube", "float", 2000)->rate == 20000);
  CHECK(read.find(name, "0:0", "cube", "float", 0)->n == 1000);
  CHECK(read.find(name, "1:0", "cube", "double", 1000)->rate ==
        5000);  // the second of two devices of the same name
  CHECK(read.find(name, "2:0", "cube", "double", 1000)->rate == 10000);  // another place: any of them
  CHECK(read.find(name, "0:0", "cube", "float", 5000) == nullptr);
  CHECK(read.find(name, "0:0", "square", "float", 1000) == nullptr);
  CHECK(read.find("another", "0:0", "cube", "float", 1000) == nullptr);
}

TEST_CASE("ratios are new rates over earlier rates") {
  const EarlierRecord read = read_text(as_json(made_record()).dump());
  BenchRecord later = made_record();
  later.rows[0].measures.seconds = {0.05};  // twice as fast
  later.rows[0].adjacency.seconds = {0.4};  // half as fast
  later.rows[1].failure = "out of memory";  // no ratio
  later.rows[2].n = 5000;                   // no counterpart
  const auto ratios = compare(later, read);
  REQUIRE(ratios.size() == 2);
  CHECK(ratios[0].measures == doctest::Approx(2));
  CHECK(ratios[0].adjacency == doctest::Approx(0.5));
  CHECK(ratios[0].least() == doctest::Approx(0.5));
  CHECK(ratios[1].least() == doctest::Approx(1));
  const std::string text = comparison(later, read, ratios);
  CHECK(text.find("2.00") != std::string::npos);
  CHECK(text.find("1 row is not in that file") != std::string::npos);
}

TEST_CASE("files that are not records are refused with the fault") {
  CHECK(refusal([](json&) {}) == "");
  CHECK(says(refusal([](json& j) { j = json::array(); }), "'format' is not"));
  CHECK(says(refusal([](json& j) { j.erase("format"); }), "'format' is not"));
  CHECK(says(refusal([](json& j) { j["format_version"] = 2; }), "format version 2"));
  CHECK(says(refusal([](json& j) { j.erase("rows"); }), "rows"));
  CHECK(says(refusal([](json& j) { j["rows"] = 5; }), "row 0"));
  CHECK(says(refusal([](json& j) { j["date"] = 7; }), "the file"));
  CHECK(says(refusal([](json& j) { j["rows"][2].erase("domain"); }), "row 2: "));
  CHECK(says(refusal([](json& j) { j["rows"][1]["n"] = -5; }), "row 1: 'n'"));
  CHECK(says(refusal([](json& j) { j["rows"][1]["n"] = 1.5; }), "row 1: 'n'"));
  CHECK(says(refusal([](json& j) { j["rows"][3]["measures"]["cells_per_second"] = 0; }), "row 3: "));
  CHECK(says(refusal([](json& j) { j["rows"][3]["adjacency"]["cells_per_second"] = "fast"; }), "row 3: "));
  CHECK_THROWS_WITH_AS(read_text("{\"format\": "), doctest::Contains("is not JSON at byte"), Error);
  CHECK_THROWS_WITH_AS(read_text(""), doctest::Contains("is empty"), Error);
  CHECK_THROWS_WITH_AS(read_record("no/such.json"), doctest::Contains("no such file"), Error);
}
