// Records of the benchmark: written, read back, compared, refused.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "apps/bench/comparison.hpp"
#include "apps/bench/sizes.hpp"
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
  row.measures.seconds = {1.05 * seconds, seconds};
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

SavedRecord read_text(const std::string& text) {
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
  const SavedRecord read = read_text(as_json(made_record()).dump());
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
  const SavedRecord read = read_text(as_json(record).dump());
  CHECK(read.revision == "");
  CHECK(read.rows.size() == 3);
}

TEST_CASE("rows are found by device, domain, precision and seeds") {
  const SavedRecord read = read_text(as_json(made_record()).dump());
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
  const SavedRecord read = read_text(as_json(made_record()).dump());
  BenchRecord later = made_record();
  later.rows[0].measures.seconds = {0.05};  // twice as fast
  later.rows[0].adjacency.seconds = {0.4};  // half as fast
  later.rows[1].failure = "out of memory";  // no ratio
  later.rows[2].n = 5000;                   // no counterpart
  const SavedRecord now = saved(later, "");
  const auto ratios = same_rows(now, read);
  REQUIRE(ratios.size() == 2);
  CHECK(ratios[0].measures.value == doctest::Approx(2));
  CHECK(ratios[0].adjacency.value == doctest::Approx(0.5));
  CHECK(ratios[0].least().value == doctest::Approx(0.5));
  CHECK(ratios[1].least().value == doctest::Approx(1));
  const std::string text = comparison(now, read, ratios);
  CHECK(text.find("2.00") != std::string::npos);
  CHECK(text.find("1 row is not in that file") != std::string::npos);
}

TEST_CASE("what is saved is what is read back") {
  const BenchRecord record = made_record();
  const SavedRecord direct = saved(record, "a name"), read = read_text(as_json(record).dump());
  REQUIRE(direct.rows.size() == read.rows.size());
  CHECK(direct.path == "a name");
  CHECK(std::tie(direct.version, direct.revision, direct.date, direct.description) ==
        std::tie(read.version, read.revision, read.date, read.description));
  const auto all = [](const SavedRow& row) {
    return std::tie(row.device, row.selector, row.domain, row.precision, row.n, row.rate, row.adjacency_rate);
  };
  for (std::size_t k = 0; k < read.rows.size(); ++k) CHECK(all(direct.rows[k]) == all(read.rows[k]));
}

TEST_CASE("a description is kept, and older files have none") {
  BenchRecord record = made_record();
  record.description = "nothing else runs; \"quoted\"";
  CHECK(read_text(as_json(record).dump()).description == record.description);
  json older = as_json(record);
  for (const char* key : {"description", "host", "headlines", "used_by_others"}) older.erase(key);
  for (json& row : older["rows"])
    for (const char* kind : {"measures", "adjacency"}) row[kind].erase("scatter");
  const SavedRecord read = read_text(older.dump());
  CHECK(read.description == "");
  CHECK(read.processors == 0);
  CHECK(read.rows[0].scatter == 0);
  CHECK(same_rows(saved(record, ""), read).size() == 4);
}

TEST_CASE("two saved records: other numbers of seeds are compared, and said to be rough") {
  const SavedRecord then = saved(made_record(), "then.json");
  BenchRecord changed = made_record();
  changed.rows = {made_row("0:0", "double", 4000, 0.1)};
  const SavedRecord now = saved(changed, "now.json");
  CHECK(same_rows(now, then).empty());
  const auto ratios = alike_rows(now, then);
  REQUIRE(ratios.size() == 1);
  CHECK(ratios[0].then->n == 1000);
  CHECK(ratios[0].measures.value == doctest::Approx(4));
  const std::string text = comparison(now, then, ratios);
  CHECK(text.find("(with 1,000 seeds)") != std::string::npos);
  CHECK(text.find("rough") != std::string::npos);
  CHECK(text.find("Rates in now.json") == 0);
  CHECK(comparison(then, then, alike_rows(then, then)).find("rough") == std::string::npos);
}

TEST_CASE("two saved records of different devices: each row with every other device") {
  const SavedRecord then = saved(made_record(), "then.json");
  BenchRecord other = made_record();
  other.rows = {made_row("0:0", "double", 1000, 0.01), made_row("0:0", "float", 2000, 0.01)};
  other.rows[0].device = other.rows[1].device = "a faster device";
  const SavedRecord now = saved(other, "now.json");
  const auto ratios = alike_rows(now, then);
  REQUIRE(ratios.size() == 2);
  CHECK(ratios[0].measures.value == doctest::Approx(10));
  CHECK(ratios[1].then->n == 2000);  // the same number of seeds comes first
  CHECK(comparison(now, then, ratios).find("a faster device over device of two units") != std::string::npos);
  other.rows.push_back(made_row("0:0", "double", 1000, 0.1));  // a device that both have
  CHECK(alike_rows(saved(other, ""), then).size() == 1);
}

TEST_CASE("every figure is shown with its scatter, and rows that scatter much are counted") {
  BenchRecord record = made_record();
  for (BenchRow& row : record.rows) row.measures.seconds = {0.1, 0.104, 0.3};
  CHECK(scatter_notes(record) == "");
  CHECK(table_line(record.rows[0]).find("10,000   ±4 %") != std::string::npos);
  record.rows[2].adjacency.seconds = {0.1, 0.13, 0.13};
  CHECK(table_line(record.rows[2]).find("20,000  ±30 %") != std::string::npos);
  CHECK(scatter_notes(record) == "note: runs of 1 of 4 rows scatter by more than 10 %, the most by 30 %\n");
  record.rows[2].failure = "out of memory";
  CHECK(scatter_notes(record) == "");
}

TEST_CASE("runs that scatter much give a figure all the same, which says so, and so do ratios") {
  BenchRecord record = made_record();
  record.rows[0].measures.seconds = {0.1, 0.12, 0.12};
  CHECK(headline(record).find("0.01 million cells a second ±20 %: cube, white, 1,000 seeds, double") == 0);
  const json figures = as_json(record)["headlines"];
  CHECK(figures.size() == 2);
  CHECK(figures[0]["scatter"].get<double>() == doctest::Approx(0.2));
  CHECK(as_json(record)["rows"][0]["scattered"] == true);
  const SavedRecord scattered = read_text(as_json(record).dump());
  CHECK(scattered.rows[0].scatter == doctest::Approx(0.2));
  CHECK(scattered.rows[0].adjacency_scatter == 0);
}

TEST_CASE("a ratio has the scatter of both runs, and is marked where it shows no difference beyond that") {
  BenchRecord record = made_record();
  record.rows = {made_row("0:0", "double", 1000, 0.1)};  // scatters by 5 %; with adjacency not at all
  const SavedRecord then = saved(record, "then.json");
  const auto text = [&](double seconds) {
    BenchRecord changed = record;
    changed.rows = {made_row("0:0", "double", 1000, seconds)};
    const SavedRecord now = saved(changed, "");
    return comparison(now, then, same_rows(now, then));
  };
  CHECK(text(0.1).find("~1.00  ±10 %      1.00   ±0 %") != std::string::npos);
  CHECK(text(0.108).find("~0.93  ±10 %      0.93   ±0 %") != std::string::npos);
  CHECK(text(0.092).find("~1.09  ±10 %      1.09   ±0 %") != std::string::npos);
  CHECK(text(0.08).find(" 1.25  ±10 %      1.25   ±0 %") != std::string::npos);
  CHECK(text(0.08).find("~") == std::string::npos);
  CHECK(text(0.1).find("no difference beyond the scatter") != std::string::npos);
}

TEST_CASE("a comparison says that others kept a machine busy") {
  BenchRecord record = made_record();
  record.host.processors = 2;
  record.others = 1.25;
  const SavedRecord busy = read_text(as_json(record).dump());
  CHECK(busy.others == 1.25);
  record.others = 0.01;
  const SavedRecord calm = saved(record, "calm.json");
  const std::string text = comparison(calm, busy, same_rows(calm, busy));
  CHECK(text.find("old.json was measured, other programs kept 1.2 of its processors busy") !=
        std::string::npos);
  CHECK(comparison(calm, calm, same_rows(calm, calm)).find("busy") == std::string::npos);
  record.others = 1.25;
  CHECK(scatter_notes(record).find("other programs kept 1.2 of its processors busy") != std::string::npos);
  record.others.reset();  // where the system does not say
  CHECK(as_json(record)["used_by_others"].is_null());
  CHECK(read_text(as_json(record).dump()).others == 0);
}

TEST_CASE("devices of one record are compared row by row") {
  BenchRecord record = made_record();  // 1:0 has one row of those of 0:0, half as fast
  const std::string text = comparison_of_devices(saved(record, ""));
  CHECK(text.find("Rates of 1:0 over those of 0:0\n") == 0);
  CHECK(text.find(" 0.50  ±10 %      0.50   ±0 %") != std::string::npos);
  CHECK(text.find("float") == std::string::npos);
  record.rows.pop_back();
  CHECK(comparison_of_devices(saved(record, "")) == "");
}

TEST_CASE("a later measurement takes the numbers of seeds of the earlier record") {
  const SavedRecord read = read_text(as_json(made_record()).dump());
  using Sizes = std::vector<std::size_t>;
  CHECK(read.sizes("device of two units", "0:0", "cube", "float") == Sizes{1000, 2000});
  CHECK(read.sizes("device of two units", "0:0", "square", "float") == Sizes{});
  CHECK(read.sizes("another", "0:0", "cube", "float") == Sizes{});
}

TEST_CASE("the figure of a device is that of its first row in the cube") {
  BenchRecord record = made_record();
  record.rows[0].failure = "out of memory";
  auto found = record.headlines();
  REQUIRE(found.size() == 2);
  CHECK(found[0] == &record.rows[2]);  // of the first precision, that of most seeds
  CHECK(found[1] == &record.rows[3]);
  for (BenchRow& row : record.rows) row.n = headline_seeds;
  for (const std::size_t k : {1, 2}) record.rows[k].measures.seconds = {0.5};
  const std::string text = headline(record);
  CHECK(text.find("2 million cells a second ±0 %: cube, white, 1,000,000 seeds, float") == 0);
  CHECK(text.find("to compare") == std::string::npos);
  for (BenchRow& row : record.rows) row.n = quick_headline_seeds;
  CHECK(headline(record).find("--quick") != std::string::npos);
  for (BenchRow& row : record.rows) row.domain = "square";
  CHECK(headline(record) == "");
}

TEST_CASE("the machine is described as far as it is known") {
  const HostInfo host = host_info();
  CHECK(host.processors > 0);
  CHECK(host.memory_bytes > 1 << 20);
  CHECK(host.system.find("Linux") != std::string::npos);
  CHECK(host.opencl_loader.find("OpenCL") != std::string::npos);
  CHECK(host.cpu != "");
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
