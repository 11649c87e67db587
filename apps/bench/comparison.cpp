#include "apps/bench/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/common.hpp"

namespace powercell::app {
namespace {

BenchRatio ratio_of(const SavedRow& now, const SavedRow& then) {
  return {&now,
          &then,
          {now.rate / then.rate, now.scatter + then.scatter},
          {now.adjacency_rate / then.adjacency_rate, now.adjacency_scatter + then.adjacency_scatter}};
}

bool share_a_device(const SavedRecord& a, const SavedRecord& b) {
  return std::any_of(a.rows.begin(), a.rows.end(), [&](const SavedRow& row) {
    return std::any_of(b.rows.begin(), b.rows.end(),
                       [&](const SavedRow& other) { return other.device == row.device; });
  });
}

std::string origin(const SavedRecord& record) {
  std::string text = fmt::format("{} ({}{}{}, {})", record.path, record.version,
                                 record.revision.empty() ? "" : " ", record.revision, record.date);
  if (!record.description.empty()) text += ": " + io::readable(record.description);
  return text;
}

std::string devices_of_ratio(const BenchRatio& ratio) {
  const std::string &now = ratio.now->device, &then = ratio.then->device;
  return now == then ? now : now + " over " + then;
}

std::string ratio_text(const Ratio& ratio) {
  return fmt::format("{:>10}{:>7}", fmt::format("{}{:.2f}", ratio.tells_nothing() ? "~" : "", ratio.value),
                     fmt::format("±{:.0f} %", 100 * ratio.scatter));
}

std::string table(const std::vector<BenchRatio>& ratios) {
  std::string text = fmt::format("{:<12}{:<10}{:>11}{:>10}{:>7}{:>10}{:>7}  {}\n", "domain", "precision",
                                 "seeds", "cells/s", "", "+adjac.", "", "device");
  bool other_sizes = false, unclear = false;
  for (const BenchRatio& ratio : ratios) {
    const SavedRow& row = *ratio.now;
    unclear = unclear || ratio.measures.tells_nothing() || ratio.adjacency.tells_nothing();
    std::string device = devices_of_ratio(ratio);
    if (row.n != ratio.then->n) {
      device += fmt::format(" (with {} seeds)", with_commas(ratio.then->n));
      other_sizes = true;
    }
    text += fmt::format("{:<12}{:<10}{:>11}{}{}  {}\n", row.domain, row.precision, with_commas(row.n),
                        ratio_text(ratio.measures), ratio_text(ratio.adjacency), device);
  }
  if (unclear) text += "~: no difference beyond the scatter of the runs of both (±).\n";
  if (other_sizes) text += "Where the numbers of seeds differ, the ratio is a rough one.\n";
  return text;
}

}  // namespace

bool Ratio::tells_nothing() const {
  return value < 1 + scatter && 1 / value < 1 + scatter;
}

std::vector<BenchRatio> same_rows(const SavedRecord& now, const SavedRecord& then) {
  std::vector<BenchRatio> ratios;
  for (const SavedRow& row : now.rows)
    if (const SavedRow* other = then.find(row.device, row.selector, row.domain, row.precision, row.n))
      ratios.push_back(ratio_of(row, *other));
  return ratios;
}

std::vector<BenchRatio> alike_rows(const SavedRecord& now, const SavedRecord& then) {
  std::set<std::string> others;  // devices of the earlier record, if none is in both
  if (!share_a_device(now, then))
    for (const SavedRow& row : then.rows) others.insert(row.device);
  std::vector<BenchRatio> ratios;
  for (const SavedRow& row : now.rows)
    for (const std::string& device : others.empty() ? std::set<std::string>{row.device} : others) {
      const SavedRow* other = then.find(device, row.selector, row.domain, row.precision, row.n);
      if (!other) other = then.find(device, row.selector, row.domain, row.precision, 0);
      if (other) ratios.push_back(ratio_of(row, *other));
    }
  return ratios;
}

std::string comparison(const SavedRecord& now, const SavedRecord& then,
                       const std::vector<BenchRatio>& ratios) {
  std::string text = now.path.empty() ? "" : fmt::format("Rates in {}\n", origin(now));
  text += fmt::format("{} those in {}\n", now.path.empty() ? "Rates over" : "over", origin(then));
  text += table(ratios);
  std::set<const SavedRow*> compared;
  for (const BenchRatio& ratio : ratios) compared.insert(ratio.now);
  if (const std::size_t without = now.rows.size() - compared.size(); without > 0)
    text += fmt::format("{} row{} not in {}\n", without, without == 1 ? " is" : "s are",
                        now.path.empty() ? "that file" : then.path);
  for (const SavedRecord* record : {&now, &then})
    if (const std::string busy = busy_text(record->processors, record->others); !busy.empty())
      text += fmt::format(
          "note: while {} was measured, {}: its rates are lower for it, also beyond the scatter\n",
          record->path.empty() ? "this record" : record->path, busy);
  return text;
}

std::string busy_text(unsigned processors, double others) {
  constexpr double little = 0.05;
  if (others <= little * processors) return {};
  return fmt::format("other programs kept {:.2g} of its processors busy", others);
}

std::string comparison_of_devices(const SavedRecord& record) {
  std::vector<std::string> selectors;
  for (const SavedRow& row : record.rows)
    if (std::find(selectors.begin(), selectors.end(), row.selector) == selectors.end())
      selectors.push_back(row.selector);
  std::string text;
  for (std::size_t k = 1; k < selectors.size(); ++k) {
    const SavedRecord first = record.of_device(selectors[0]), other = record.of_device(selectors[k]);
    std::vector<BenchRatio> ratios;
    for (const SavedRow& row : other.rows)
      for (const SavedRow& same : first.rows)
        if (same.domain == row.domain && same.precision == row.precision && same.n == row.n)
          ratios.push_back(ratio_of(row, same));
    if (ratios.empty()) continue;
    text += fmt::format("Rates of {} over those of {}\n", selectors[k], selectors[0]) + table(ratios);
  }
  return text;
}

}  // namespace powercell::app
