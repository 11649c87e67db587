#include "apps/bench/record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/sizes.hpp"
#include "apps/common.hpp"

namespace powercell::app {

std::string BenchRow::title() const {
  return fmt::format("{} in {} with {} seeds on {}", domain, precision, with_commas(n), device);
}
double BenchRow::scatter() const {
  return std::max(measures.scatter(), adjacency.scatter());
}
std::size_t BenchRow::real_bytes() const {
  return precision == "float" ? 4 : 8;
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
  return rates.copied_bytes > 0 ? rate() * work.bytes(real_bytes()) / rates.copied_bytes : 0;
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
    const auto same = std::find_if(found.begin(), found.end(),
                                   [&](const BenchRow* other) { return other->selector == row.selector; });
    if (same == found.end())
      found.push_back(&row);
    else if ((*same)->precision == row.precision && (*same)->n < row.n)
      *same = &row;
  }
  return found;
}

}  // namespace powercell::app
