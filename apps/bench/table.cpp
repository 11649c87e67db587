#include "apps/bench/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/comparison.hpp"
#include "apps/bench/sizes.hpp"
#include "apps/common.hpp"

namespace powercell::app {
namespace {

std::string percent(double fraction) {
  return fmt::format("{:.2g} %", 100 * fraction);
}

std::string table_line(const std::string& domain, const std::string& precision, const std::string& n) {
  return fmt::format("{:<12}{:<10}{:>11}", domain, precision, n);
}

std::string rate_text(double rate, const TimedRuns& runs) {
  return fmt::format("{:>12}{:>7}", with_commas(static_cast<std::size_t>(rate)),
                     scatter_text(runs.scatter()));
}

}  // namespace

std::string scatter_text(double scatter) {
  return fmt::format("±{:.0f} %", 100 * scatter);
}

std::string device_lines(const BenchDevice& device) {
  std::string text;
  const DeviceLatencies& calls = device.latencies;
  if (calls.launch > 0)
    text += fmt::format("     a launch takes {:.1f} us {}, a transfer {:.1f} us {}\n", 1e6 * calls.launch,
                        scatter_text(calls.launch_scatter), 1e6 * calls.transfer,
                        scatter_text(calls.transfer_scatter));
  for (const BenchRates& measured : device.rates)
    text += fmt::format("     {}: {:.1f} GB/s copied {}, {:.1f} Gflop/s multiplied and added {}\n",
                        measured.precision, 1e-9 * measured.rates.copied_bytes,
                        scatter_text(measured.rates.copied_scatter), 1e-9 * measured.rates.operations,
                        scatter_text(measured.rates.operations_scatter));
  if (!device.transfers.empty())
    text += fmt::format("     {:<9}{:>19}{:>21}\n", "transfer", "to device, GB/s", "to host, GB/s");
  for (const BenchTransfers& measured : device.transfers)
    text += fmt::format("     {:<9}{:>12.3g}{:>7}{:>14.3g}{:>7}\n", bytes_text(measured.bytes),
                        1e-9 * measured.rates.to_device, scatter_text(measured.rates.to_device_scatter),
                        1e-9 * measured.rates.to_host, scatter_text(measured.rates.to_host_scatter));
  return text;
}

std::string table_head() {
  return table_line("domain", "precision", "seeds") +
         fmt::format("{:>12}{:>7}{:>12}{:>7}{:>12}{:>11}{:>9}{:>9}", "cells/s", "", "+adjacency", "",
                     "arithmetic", "bandwidth", "build s", "first s");
}

std::string table_line(const BenchRow& row) {
  const std::string start = table_line(row.domain, row.precision, row.n ? with_commas(row.n) : "");
  if (!row.failure.empty()) return start + "  FAILED: " + row.failure;
  return start + rate_text(row.rate(), row.measures) + rate_text(row.adjacency_rate(), row.adjacency) +
         fmt::format("{:>12}{:>11}{:>9.2f}{:>9.2f}", percent(row.arithmetic_fraction()),
                     percent(row.bandwidth_fraction()), row.build, row.first_result);
}

std::string table_line(const LeftOut& row) {
  return table_line(row.domain, row.precision, with_commas(row.n)) + "  left out: " + row.reason;
}

std::string scatter_notes(const BenchRecord& record) {
  std::size_t rows = 0, scattered = 0;
  double most = 0;
  for (const BenchRow& row : record.rows) {
    if (!row.failure.empty()) continue;
    ++rows;
    scattered += row.scatter() > much_scatter ? 1 : 0;
    most = std::max(most, row.scatter());
  }
  std::string text;
  if (scattered > 0)
    text += fmt::format("note: runs of {} of {} rows scatter by more than {:.0f} %, the most by {:.0f} %\n",
                        scattered, rows, 100 * much_scatter, 100 * most);
  if (const std::string busy = busy_text(record.host.processors, record.others.value_or(0)); !busy.empty())
    text += fmt::format(
        "note: while this machine was measured, {}: rates are lower for it, also beyond the scatter\n", busy);
  return text;
}

std::string headline(const BenchRecord& record) {
  std::string text;
  for (const BenchRow* row : record.headlines()) {
    text += fmt::format("{:.3g} million cells a second {}: {}, white, {} seeds, {}, {}", 1e-6 * row->rate(),
                        scatter_text(row->measures.scatter()), row->domain, with_commas(row->n),
                        row->precision, row->device);
    if (row->n != headline_seeds)
      text +=
          fmt::format(" (to compare devices, the figure for {} seeds is used{})", with_commas(headline_seeds),
                      row->n == quick_headline_seeds ? ": leave --quick out" : "");
    text += "\n";
  }
  return text;
}

}  // namespace powercell::app
