#include "apps/bench/table.hpp"

#include <fmt/format.h>

#include "apps/common.hpp"

namespace powercell::app {
namespace {

std::string rate_text(double rate) {
  return with_commas(static_cast<std::size_t>(rate));
}

std::string percent(double fraction) {
  return fmt::format("{:.2g} %", 100 * fraction);
}

std::string line(const std::string& domain, const std::string& precision, const std::string& n) {
  return fmt::format("{:<12}{:<10}{:>11}", domain, precision, n);
}

}  // namespace

std::string table_head() {
  return line("domain", "precision", "seeds") + fmt::format("{:>13}{:>13}{:>12}{:>11}{:>9}{:>9}", "cells/s",
                                                            "+adjacency", "arithmetic", "bandwidth",
                                                            "build s", "first s");
}

std::string table_line(const BenchRow& row) {
  const std::string start = line(row.domain, row.precision, row.n ? with_commas(row.n) : "");
  if (!row.failure.empty()) return start + "  FAILED: " + row.failure;
  return start + fmt::format("{:>13}{:>13}{:>12}{:>11}{:>9.2f}{:>9.2f}", rate_text(row.rate()),
                             rate_text(row.adjacency_rate()), percent(row.arithmetic_fraction()),
                             percent(row.bandwidth_fraction()), row.build, row.first_result);
}

std::vector<BenchRatio> compare(const BenchRecord& record, const EarlierRecord& earlier) {
  std::vector<BenchRatio> ratios;
  for (const BenchRow& row : record.rows) {
    if (!row.failure.empty()) continue;
    const EarlierRow* then = earlier.find(row.device, row.selector, row.domain, row.precision, row.n);
    if (then) ratios.push_back({&row, row.rate() / then->rate, row.adjacency_rate() / then->adjacency_rate});
  }
  return ratios;
}

std::string comparison(const BenchRecord& record, const EarlierRecord& earlier,
                       const std::vector<BenchRatio>& ratios) {
  std::string text = fmt::format("Rates over those in {} ({}{}{}, {}):\n", earlier.path, earlier.version,
                                 earlier.revision.empty() ? "" : " ", earlier.revision, earlier.date);
  text += line("domain", "precision", "seeds") + fmt::format("{:>13}{:>13}\n", "cells/s", "+adjacency");
  for (const BenchRatio& ratio : ratios)
    text += line(ratio.row->domain, ratio.row->precision, with_commas(ratio.row->n)) +
            fmt::format("{:>13.2f}{:>13.2f}  {}\n", ratio.measures, ratio.adjacency, ratio.row->device);
  const std::size_t without = record.rows.size() - record.failures() - ratios.size();
  if (without > 0)
    text += fmt::format("{} row{} not in that file\n", without, without == 1 ? " is" : "s are");
  return text;
}

}  // namespace powercell::app
