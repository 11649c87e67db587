#include "apps/bench/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/common.hpp"

namespace powercell::app {
namespace {

/// Of runs that scatter much the best is no result: "~123,456".
std::string rate_text(double rate, bool scattered) {
  return (scattered ? "~" : "") + with_commas(static_cast<std::size_t>(rate));
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
  return start + fmt::format("{:>13}{:>13}{:>12}{:>11}{:>9.2f}{:>9.2f}",
                             rate_text(row.rate(), row.measures.scatter() > much_scatter),
                             rate_text(row.adjacency_rate(), row.adjacency.scatter() > much_scatter),
                             percent(row.arithmetic_fraction()), percent(row.bandwidth_fraction()), row.build,
                             row.first_result);
}

std::string scatter_notes(const BenchRecord& record) {
  std::string text;
  for (const BenchRow& row : record.rows) {
    const double scatter = row.scatter();
    if (row.failure.empty() && scatter > much_scatter)
      text += fmt::format(
          "note: {}: the median of {} runs took {:.0f} % longer than the best, which is no result (~)\n",
          row.title(), row.measures.seconds.size(), 100 * scatter);
  }
  if (text.empty()) return text;
  return text +
         "      Something else keeps this machine busy, or its clock changes: stop that, or raise "
         "--repeat.\n";
}

std::string headline(const BenchRecord& record) {
  std::string text;
  for (const BenchRow* row : record.headlines()) {
    if (row->scatter() > much_scatter) {
      text += fmt::format("no figure for {}: the runs of {} in {} scatter by {:.0f} %\n", row->device,
                          row->domain, row->precision, 100 * row->scatter());
      continue;
    }
    text += fmt::format("{:.3g} million cells a second: {}, white, {} seeds, {}, {}", 1e-6 * row->rate(),
                        row->domain, with_commas(row->n), row->precision, row->device);
    if (row->n != headline_seeds)
      text +=
          fmt::format(" (to compare devices, the figure for {} seeds is used{})", with_commas(headline_seeds),
                      row->n == quick_headline_seeds ? ": leave --quick out" : "");
    text += "\n";
  }
  return text;
}

}  // namespace powercell::app
