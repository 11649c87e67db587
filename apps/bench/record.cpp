#include "apps/bench/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/bench/saved_record.hpp"
#include "apps/common.hpp"

namespace powercell::app {
namespace {

using nlohmann::json;

std::size_t real_bytes(const std::string& precision) {
  return precision == "float" ? 4 : 8;
}

json runs_json(const TimedRuns& runs, double rate) {
  const Timings& t = runs.phases;
  return {{"cells_per_second", rate},
          {"seconds", runs.seconds},
          {"scatter", runs.scatter()},
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
  out["scattered"] = row.scatter() > much_scatter;
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

json host_json(const HostInfo& host) {
  return {{"cpu", host.cpu},
          {"processors", host.processors},
          {"memory_bytes", host.memory_bytes},
          {"system", host.system},
          {"opencl_loader", host.opencl_loader}};
}

json device_json(const BenchDevice& measured) {
  const DeviceInfo& device = measured.info;
  return {{"device", device.selector()},
          {"name", device.name},
          {"platform", device.platform_name},
          {"vendor", device.vendor},
          {"driver_version", device.driver_version},
          {"opencl_c_version", device.opencl_c_version},
          {"compute_units", device.compute_units},
          {"clock_mhz", device.clock_mhz},
          {"memory_bytes", device.memory_bytes},
          {"fp64", device.fp64},
          {"launch_seconds", measured.latencies.launch},
          {"transfer_seconds", measured.latencies.transfer}};
}

}  // namespace

double TimedRuns::best() const {
  return seconds.empty() ? 0 : *std::min_element(seconds.begin(), seconds.end());
}

double TimedRuns::scatter() const {
  if (seconds.size() < 2) return 0;
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2] / sorted.front() - 1;
}

std::string BenchRow::title() const {
  return fmt::format("{} in {} with {} seeds on {}", domain, precision, with_commas(n), device);
}
double BenchRow::scatter() const {
  return std::max(measures.scatter(), adjacency.scatter());
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

std::vector<const BenchRow*> BenchRecord::headlines() const {
  std::vector<const BenchRow*> found;
  for (const BenchRow& row : rows) {
    if (row.domain != headline_domain || !row.failure.empty()) continue;
    const auto same = [&](const BenchRow* other) { return other->selector == row.selector; };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back(&row);
  }
  return found;
}

json as_json(const BenchRecord& record) {
  json devices = json::array(), rows = json::array(), headlines = json::array();
  for (const BenchRow* row : record.headlines())
    if (row->scatter() <= much_scatter)
      headlines.push_back({{"device", row->device},
                           {"precision", row->precision},
                           {"n", row->n},
                           {"million_cells_per_second", 1e-6 * row->rate()}});
  for (const BenchDevice& device : record.devices) devices.push_back(device_json(device));
  for (const BenchRow& row : record.rows) rows.push_back(row_json(row));
  return {{"format", bench_format},
          {"format_version", bench_format_version},
          {"version", version()},
          {"revision", record.revision.empty() ? json() : json(record.revision)},
          {"date", record.date},
          {"threads", record.threads},
          {"cold", record.cold},
          {"repeat", record.repeat},
          {"seconds", record.seconds},
          {"passed", record.failures() == 0},
          {"description", record.description},
          {"host", host_json(record.host)},
          {"headlines", headlines},
          {"devices", devices},
          {"rows", rows}};
}

}  // namespace powercell::app
