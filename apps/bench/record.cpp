#include "apps/bench/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common.hpp"
#include "apps/io/read_file.hpp"

namespace powercell::app {
namespace {

using nlohmann::json;

constexpr const char* format_name = "powercell bench";
constexpr int format_version = 1;

std::size_t real_bytes(const std::string& precision) {
  return precision == "float" ? 4 : 8;
}

json runs_json(const TimedRuns& runs, double rate) {
  const Timings& t = runs.phases;
  return {{"cells_per_second", rate},
          {"seconds", runs.seconds},
          {"phases",
           {{"total", t.total},
            {"prepare", t.prepare},
            {"pairs", t.pairs},
            {"neighbors", t.neighbors},
            {"clip", t.clip},
            {"collect", t.collect}}},
          {"pairs", t.pair_count},
          {"retried", t.retried},
          {"uncertain", t.uncertain},
          {"on_host", t.on_host}};
}

json work_json(const BenchRow& row) {
  const Work& work = row.work;
  return {{"operations", work.operations()},
          {"bytes", work.bytes(real_bytes(row.precision))},
          {"pieces", work.pieces},
          {"corners", work.corners},
          {"triangles", work.triangles},
          {"near_seeds", work.near},
          {"corner_tests", work.corner_tests}};
}

json row_json(const BenchRow& row) {
  json out = {{"device", row.device},       {"selector", row.selector},     {"domain", row.domain},
              {"precision", row.precision}, {"neighbors", row.neighbors},   {"n", row.n},
              {"regions", row.regions},     {"passed", row.failure.empty()}};
  if (!row.failure.empty()) {
    out["failure"] = row.failure;
    return out;
  }
  out["measures"] = runs_json(row.measures, row.rate());
  out["adjacency"] = runs_json(row.adjacency, row.adjacency_rate());
  out["build_seconds"] = row.build;
  out["first_result_seconds"] = row.first_result;
  out["relative_error"] = row.relative_error;
  out["work_per_cell"] = work_json(row);
  out["device_copied_bytes_per_second"] = row.rates.copied_bytes;
  out["device_operations_per_second"] = row.rates.operations;
  out["arithmetic_fraction"] = row.arithmetic_fraction();
  out["bandwidth_fraction"] = row.bandwidth_fraction();
  return out;
}

json device_json(const DeviceInfo& device) {
  return {{"device", device.selector()},
          {"name", device.name},
          {"platform", device.platform_name},
          {"vendor", device.vendor},
          {"driver_version", device.driver_version},
          {"opencl_c_version", device.opencl_c_version},
          {"compute_units", device.compute_units},
          {"clock_mhz", device.clock_mhz},
          {"memory_bytes", device.memory_bytes},
          {"fp64", device.fp64}};
}

double rate_of(const json& row, const char* results) {
  const double rate = row.at(results).at("cells_per_second").get<double>();
  if (!(rate > 0) || !std::isfinite(rate))
    throw std::invalid_argument(fmt::format("'cells_per_second' of '{}' is not above 0", results));
  return rate;
}

std::size_t seeds_of(const json& row) {
  const json& n = row.at("n");
  if (!n.is_number_unsigned() || n.get<std::uint64_t>() == 0)
    throw std::invalid_argument("'n' is not a whole number above 0");
  return n.get<std::size_t>();
}

[[noreturn]] void refuse(const std::string& path, const std::string& fault) {
  io::fail_file(path, fault + "; --compare takes a file that 'powercell bench --json FILE' writes");
}

// The library's message without its prefix of name and number.
std::string reason(const json::exception& error) {
  const std::string text = error.what();
  const std::size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace

double TimedRuns::best() const {
  return seconds.empty() ? 0 : *std::min_element(seconds.begin(), seconds.end());
}

std::string BenchRow::title() const {
  return fmt::format("{} in {} with {} seeds on {}", domain, precision, with_commas(n), device);
}
double BenchRow::rate() const {
  return measures.best() > 0 ? static_cast<double>(n) / measures.best() : 0;
}
double BenchRow::adjacency_rate() const {
  return adjacency.best() > 0 ? static_cast<double>(n) / adjacency.best() : 0;
}
double BenchRow::arithmetic_fraction() const {
  return rates.operations > 0 ? rate() * work.operations() / rates.operations : 0;
}
double BenchRow::bandwidth_fraction() const {
  return rates.copied_bytes > 0 ? rate() * work.bytes(real_bytes(precision)) / rates.copied_bytes : 0;
}

std::size_t BenchRecord::failures() const {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const BenchRow& row) { return !row.failure.empty(); }));
}

std::string BenchRecord::failure() const {
  for (const BenchRow& row : rows)
    if (!row.failure.empty())
      return fmt::format("{} of {} rows failed; {}: {}", failures(), rows.size(), row.title(), row.failure);
  return {};
}

json as_json(const BenchRecord& record) {
  json devices = json::array(), rows = json::array();
  for (const DeviceInfo& device : record.devices) devices.push_back(device_json(device));
  for (const BenchRow& row : record.rows) rows.push_back(row_json(row));
  return {{"format", format_name},     {"format_version", format_version},
          {"version", version()},      {"revision", record.revision.empty() ? json() : json(record.revision)},
          {"date", record.date},       {"threads", record.threads},
          {"cold", record.cold},       {"repeat", record.repeat},
          {"seconds", record.seconds}, {"passed", record.failures() == 0},
          {"devices", devices},        {"rows", rows}};
}

const EarlierRow* EarlierRecord::find(const std::string& device, const std::string& selector,
                                      const std::string& domain, const std::string& precision,
                                      std::size_t n) const {
  const EarlierRow* found = nullptr;
  for (const EarlierRow& row : rows) {
    if (row.device != device || row.domain != domain || row.precision != precision) continue;
    if (n != 0 && row.n != n) continue;
    if (!found || (found->selector != selector && row.selector == selector)) found = &row;
  }
  return found;
}

EarlierRecord parse_record(std::string_view bytes, const std::string& name) {
  EarlierRecord record;
  record.path = name;
  std::string reading = "the file";
  try {
    const json whole = json::parse(bytes);
    if (!whole.is_object() || whole.value("format", json()) != format_name)
      refuse(name, fmt::format("is JSON, but its 'format' is not '{}'", format_name));
    if (const json& found = whole.at("format_version"); found != format_version)
      refuse(name,
             fmt::format("is of format version {}, this powercell reads {}", found.dump(), format_version));
    record.version = whole.at("version").get<std::string>();
    if (!whole.at("revision").is_null()) record.revision = whole.at("revision").get<std::string>();
    record.date = whole.at("date").get<std::string>();
    std::size_t number = 0;
    for (const json& row : whole.at("rows")) {
      reading = fmt::format("row {}", number++);
      if (!row.at("passed").get<bool>()) continue;
      record.rows.push_back({row.at("device").get<std::string>(), row.at("selector").get<std::string>(),
                             row.at("domain").get<std::string>(), row.at("precision").get<std::string>(),
                             seeds_of(row), rate_of(row, "measures"), rate_of(row, "adjacency")});
    }
  } catch (const json::parse_error& error) {
    refuse(name, fmt::format("is not JSON at byte {}", error.byte));
  } catch (const json::exception& error) {
    refuse(name, fmt::format("{}: {}", reading, reason(error)));
  } catch (const std::invalid_argument& error) {
    refuse(name, fmt::format("{}: {}", reading, error.what()));
  }
  return record;
}

EarlierRecord read_record(const std::string& path) {
  return parse_record(io::read_file(path), path);
}

}  // namespace powercell::app
