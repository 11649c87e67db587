#include "apps/bench/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/common.hpp"

namespace powercell::app {
namespace {

BenchRatio ratio_of(const SavedRow& now, const SavedRow& then) {
  return {&now, &then, now.rate / then.rate, now.adjacency_rate / then.adjacency_rate};
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

}  // namespace

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
  const auto line = [&](const std::string& domain, const std::string& precision, const std::string& n,
                        const std::string& measures, const std::string& adjacency,
                        const std::string& device) {
    text += fmt::format("{:<12}{:<10}{:>11}{:>13}{:>13}  {}\n", domain, precision, n, measures, adjacency,
                        device);
  };
  line("domain", "precision", "seeds", "cells/s", "+adjacency", "device");
  bool other_sizes = false, scattered = false;
  for (const BenchRatio& ratio : ratios) {
    const SavedRow& row = *ratio.now;
    const char* about = ratio.scatter() > much_scatter ? "~" : "";
    scattered = scattered || ratio.scatter() > much_scatter;
    std::string device = devices_of_ratio(ratio);
    if (row.n != ratio.then->n) {
      device += fmt::format(" (with {} seeds)", with_commas(ratio.then->n));
      other_sizes = true;
    }
    line(row.domain, row.precision, with_commas(row.n), fmt::format("{}{:.2f}", about, ratio.measures),
         fmt::format("{}{:.2f}", about, ratio.adjacency), device);
  }
  if (scattered) text += "~: the runs of either scatter so much that the ratio is no result.\n";
  if (other_sizes) text += "Where the numbers of seeds differ, the ratio is a rough one.\n";
  std::set<const SavedRow*> compared;
  for (const BenchRatio& ratio : ratios) compared.insert(ratio.now);
  if (const std::size_t without = now.rows.size() - compared.size(); without > 0)
    text += fmt::format("{} row{} not in {}\n", without, without == 1 ? " is" : "s are",
                        now.path.empty() ? "that file" : then.path);
  return text;
}

}  // namespace powercell::app
