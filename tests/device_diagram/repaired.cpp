#include "tests/device_diagram/repaired.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace powercell::test {

Options in_precision(Precision precision) {
  Options options;
  options.precision = precision;
  return options;
}

namespace {

/// A NaN equals a NaN.
bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

double in_memory(double x, Precision precision) {
  return precision == Precision::float32 ? static_cast<double>(static_cast<float>(x)) : x;
}

}  // namespace

bool same_bits(const Output& found, std::size_t i, const Measures& host, std::size_t k, Precision precision) {
  const auto d = static_cast<std::size_t>(host.dimension);
  bool equal = same(found.mass[i], in_memory(host.mass[k], precision)) &&
               same(found.second_moment[i], in_memory(host.second_moment[k], precision)) &&
               static_cast<int>(found.status[i]) == static_cast<int>(host.status[k]);
  for (std::size_t c = 0; c < d; ++c)
    equal = equal && same(found.centroid[i * d + c], in_memory(host.centroid[k * d + c], precision));
  return equal;
}

Repaired repaired(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds, std::size_t room) {
  const Job job(caller, diagram.precision(), seeds);
  const Rows rows(caller, diagram.precision(), seeds.size(), room, diagram.domain().is_periodic());
  const List list(caller, seeds.size());
  const Wanted wanted{rows.handles(), list.handles()};
  job.enqueue(diagram, wanted);
  Repaired result{job.read(), {}, {}, list.read()};
  const std::uint32_t computed = job.repair(diagram, wanted);
  result.output = job.read();
  if (computed > result.list.size()) {  // all valid ones
    result.list.clear();
    for (std::uint32_t i = 0; i < seeds.size(); ++i)
      if (result.output.status[i] != DeviceSeedStatus::invalid) result.list.push_back(i);
  }
  CHECK(computed == result.list.size());
  result.adjacency = rows.read();
  return result;
}

namespace {

/// The list has all seeds that are unfinished, and the others have the status of the exact diagram.
void check_list(const Repaired& found, const Measures& exact) {
  CHECK(std::adjacent_find(found.list.begin(), found.list.end(), std::greater_equal<>()) == found.list.end());
  std::size_t missing = 0;
  for (std::uint32_t i = 0; i < found.before.status.size(); ++i)
    missing += !std::binary_search(found.list.begin(), found.list.end(), i) &&
               static_cast<int>(found.before.status[i]) != static_cast<int>(exact.status[i]);
  CHECK(missing == 0);
}

void check_measures(const Repaired& found, const Measures& exact, Precision precision) {
  const double error = tolerance(precision) * exact.domain_measure / static_cast<double>(exact.mass.size());
  std::size_t wrong_status = 0, wrong_mass = 0, wrong_moment = 0, changed = 0;
  for (std::uint32_t i = 0; i < exact.mass.size(); ++i) {
    wrong_status += static_cast<int>(found.output.status[i]) != static_cast<int>(exact.status[i]);
    wrong_mass += !(std::abs(found.output.mass[i] - exact.mass[i]) <= error);
    wrong_moment += !(std::abs(found.output.second_moment[i] - exact.second_moment[i]) <=
                      error + tolerance(precision) * exact.second_moment[i]);
    changed += !std::binary_search(found.list.begin(), found.list.end(), i) &&
               !same(found.output.mass[i], found.before.mass[i]);
  }
  CHECK(wrong_status == 0);
  CHECK(wrong_mass == 0);
  CHECK(wrong_moment == 0);
  CHECK(changed == 0);
}

/// The entry of the other side of entry k of row i, or the number of entries.
std::size_t other_side(const Adjacency& rows, std::uint32_t i, std::uint64_t k) {
  const std::uint32_t j = rows.neighbor[k];
  for (std::uint64_t back = rows.offset[j]; back < rows.offset[j + 1]; ++back) {
    bool opposite = rows.neighbor[back] == i;
    for (std::size_t m = 0; m < 3 && !rows.shift.empty(); ++m)
      opposite = opposite && rows.shift[back][m] == -rows.shift[k][m];
    if (opposite) return back;
  }
  return rows.neighbor.size();
}

void check_adjacency(const Adjacency& found, const Adjacency& exact, double error) {
  CHECK(found.offset == exact.offset);
  REQUIRE(found.neighbor == exact.neighbor);
  CHECK(found.shift == exact.shift);
  std::size_t wrong = 0, one_sided = 0;
  for (std::uint32_t i = 0; i + 1 < found.offset.size(); ++i)
    for (std::uint64_t k = found.offset[i]; k < found.offset[i + 1]; ++k) {
      wrong += !(std::abs(found.wall[k] - exact.wall[k]) <= error);
      const std::size_t back = other_side(found, i, k);
      one_sided += back == found.wall.size() || found.wall[back] != found.wall[k];
    }
  CHECK(wrong == 0);
  CHECK(one_sided == 0);
}

/// Repaired cells are those of a Diagram of them alone, bit by bit.
void check_bits(const Repaired& found, Diagram& exact) {
  exact.select(found.list);
  const Measures& some = exact.measures();
  std::size_t different = 0;
  for (std::size_t k = 0; k < found.list.size(); ++k)
    different += !same_bits(found.output, found.list[k], some, k, exact.precision());
  CHECK(different == 0);
}

}  // namespace

std::size_t check_repaired(Caller& caller, DeviceDiagram& diagram, const SeedArray& given) {
  const Precision precision = diagram.precision();
  const SeedArray seeds = rounded_seeds(given, precision);
  Diagram exact(caller.device(), diagram.domain(), in_precision(precision));
  exact.set_seeds(seeds.view());
  const std::size_t room = 2 * exact.adjacency().neighbor.size() + 1000;
  const Repaired found = repaired(caller, diagram, seeds.view(), room);
  check_list(found, exact.measures());
  check_measures(found, exact.measures(), precision);
  check_adjacency(found.adjacency, exact.adjacency(), wall_tolerance(diagram.domain(), precision));
  Diagram alone(caller.device(), diagram.domain(), in_precision(precision));
  alone.set_seeds(seeds.view());
  check_bits(found, alone);
  return found.list.size();
}

}  // namespace powercell::test
