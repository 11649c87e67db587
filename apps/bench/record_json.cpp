// Records of the benchmark as JSON.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "apps/bench/record.hpp"
#include "apps/bench/saved_record.hpp"

namespace powercell::app {
namespace {

using nlohmann::json;

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
  return {
      {"operations", work.operations()},  {"bytes", work.bytes(row.real_bytes())}, {"pieces", work.pieces},
      {"corners", work.corners},          {"triangles", work.triangles},           {"near_seeds", work.near},
      {"corner_tests", work.corner_tests}};
}

/// What is not known is left out.
json state_json(const HostState& state) {
  json out = json::object();
  if (!state.load.empty()) out["load_averages"] = state.load;
  const std::vector<double>& clocks = state.clock_mhz;
  if (clocks.empty()) return out;
  const auto [least, most] = std::minmax_element(clocks.begin(), clocks.end());
  const double sum = std::accumulate(clocks.begin(), clocks.end(), 0.0);
  out["clock_mhz"] = {{"least", *least}, {"mean", sum / static_cast<double>(clocks.size())}, {"most", *most}};
  return out;
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
  out["state"] = state_json(row.state);
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

json rates_json(const BenchRates& measured) {
  return {{"precision", measured.precision},
          {"copied_bytes_per_second", measured.rates.copied_bytes},
          {"copied_scatter", measured.rates.copied_scatter},
          {"operations_per_second", measured.rates.operations},
          {"operations_scatter", measured.rates.operations_scatter}};
}

json transfers_json(const BenchTransfers& measured) {
  return {{"bytes", measured.bytes},
          {"to_device_bytes_per_second", measured.rates.to_device},
          {"to_device_scatter", measured.rates.to_device_scatter},
          {"to_host_bytes_per_second", measured.rates.to_host},
          {"to_host_scatter", measured.rates.to_host_scatter}};
}

json left_out_json(const LeftOut& row) {
  return {{"device", row.device}, {"selector", row.selector},
          {"domain", row.domain}, {"precision", row.precision},
          {"n", row.n},           {"reason", row.reason}};
}

template <class T, class AsJson>
json array_of(const std::vector<T>& values, const AsJson& as_json) {
  json array = json::array();
  for (const T& value : values) array.push_back(as_json(value));
  return array;
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
          {"launch_scatter", measured.latencies.launch_scatter},
          {"transfer_seconds", measured.latencies.transfer},
          {"transfer_scatter", measured.latencies.transfer_scatter},
          {"rates", array_of(measured.rates, rates_json)},
          {"transfers", array_of(measured.transfers, transfers_json)}};
}

json headline_json(const BenchRow* row) {
  return {{"device", row->device},
          {"precision", row->precision},
          {"n", row->n},
          {"million_cells_per_second", 1e-6 * row->rate()},
          {"scatter", row->measures.scatter()}};
}

}  // namespace

json as_json(const BenchRecord& record) {
  return {{"format", bench_format},
          {"format_version", bench_format_version},
          {"version", version()},
          {"revision", record.revision.empty() ? json() : json(record.revision)},
          {"date", record.date},
          {"threads", record.threads},
          {"cold", record.cold},
          {"repeat", record.repeat ? json(record.repeat) : json()},
          {"seconds", record.seconds},
          {"passed", record.failures() == 0},
          {"description", record.description},
          {"host", host_json(record.host)},
          {"used_by_others", record.others ? json(*record.others) : json()},
          {"state_before", state_json(record.before)},
          {"state_after", state_json(record.after)},
          {"headlines", array_of(record.headlines(), headline_json)},
          {"devices", array_of(record.devices, device_json)},
          {"rows", array_of(record.rows, row_json)},
          {"left_out", array_of(record.left_out, left_out_json)}};
}

}  // namespace powercell::app
