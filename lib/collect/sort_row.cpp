#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "lib/base/vector_copies.hpp"
#include "lib/collect/walls.hpp"

namespace powercell {
namespace {

constexpr std::size_t lanes = 8;       // entries compared at a time
constexpr std::size_t short_row = 64;  // up to this length, comparing all with all is the fastest

bool sort_long(const std::uint32_t* key, const double* value, std::size_t count, std::uint32_t* sorted_key,
               double* sorted_value) {
  std::vector<std::pair<std::uint32_t, double>> entries(count);
  for (std::size_t k = 0; k < count; ++k) entries[k] = {key[k], value[k]};
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  bool equal = false;
  for (std::size_t k = 0; k < count; ++k) {
    sorted_key[k] = entries[k].first;
    sorted_value[k] = entries[k].second;
    equal |= k > 0 && entries[k - 1].first == entries[k].first;
  }
  return equal;
}

}  // namespace

POWERCELL_VECTOR_COPIES
bool sort_row(const std::uint32_t* key, const double* value, std::size_t count, std::uint32_t* sorted_key,
              double* sorted_value) {
  if (count > short_row) return sort_long(key, value, count, sorted_key, sorted_value);
  // The place of an entry is the number of smaller ones. That needs no branches, and the inner loops are
  // whole vectors. `own` and `smaller` are local, since reading vectors just after their parts were written
  // stalls.
  std::array<std::int32_t, short_row> place;
  for (std::size_t block = 0; block < count; block += lanes) {
    std::array<std::int32_t, lanes> own, smaller{};
    for (std::size_t lane = 0; lane < lanes; ++lane)
      own[lane] = block + lane < count ? static_cast<std::int32_t>(key[block + lane])
                                       : std::numeric_limits<std::int32_t>::max();
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t lane = 0; lane < lanes; ++lane)
        smaller[lane] += static_cast<std::int32_t>(key[k]) < own[lane] ? 1 : 0;
    std::copy_n(smaller.begin(), lanes, place.begin() + block);
  }
  std::size_t sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += static_cast<std::size_t>(place[k]);
  const bool equal = 2 * sum + count != count * count;  // distinct places sum to count (count - 1) / 2
  for (std::size_t k = 1; equal && k < count; ++k) {
    std::int32_t before = 0;
    for (std::size_t m = 0; m < k; ++m) before += key[m] == key[k] ? 1 : 0;
    place[k] += before;
  }
  for (std::size_t k = 0; k < count; ++k) {
    sorted_key[place[k]] = key[k];
    sorted_value[place[k]] = value[k];
  }
  return equal;
}

}  // namespace powercell
