#include "lib/base/radix_sort.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "lib/base/threads.hpp"

namespace powercell {
namespace {

constexpr unsigned digit_bits = 11;  // a histogram then takes 16 KiB
constexpr std::size_t buckets = std::size_t{1} << digit_bits;
constexpr std::size_t least_by_digits = 1024;  // records; fewer are sorted faster by comparing
constexpr std::size_t least_shared = 32768;    // records per thread; fewer are faster on one thread

using Histogram = std::array<std::size_t, buckets>;

std::size_t digit(std::uint64_t key, unsigned shift) {
  return (key >> shift) & (buckets - 1);
}

/// One pass of the sort, by the digit at `shift`. Each part of `from` is counted and then written
/// independently; within a bucket the parts follow each other, so the sort is stable for any number of parts.
/// Returns false and writes nothing if all records have the same digit.
bool scatter(std::span<const KeyedIndex> from, std::span<KeyedIndex> to, unsigned shift,
             std::vector<Histogram>& histograms) {
  const std::size_t parts = histograms.size();
  const auto bound = [&](std::size_t part) { return from.size() * part / parts; };
  const int threads = static_cast<int>(parts);
  parallel_for(threads, parts, [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) {
      histograms[part].fill(0);
      for (std::size_t k = bound(part); k < bound(part + 1); ++k)
        ++histograms[part][digit(from[k].key, shift)];
    }
  });
  std::size_t sum = 0;
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::size_t before = sum;
    for (Histogram& h : histograms) {
      const std::size_t count = h[b];
      h[b] = sum;
      sum += count;
    }
    if (sum - before == from.size()) return false;
  }
  parallel_for(threads, parts, [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part)
      for (std::size_t k = bound(part); k < bound(part + 1); ++k)
        to[histograms[part][digit(from[k].key, shift)]++] = from[k];
  });
  return true;
}

/// Sorts by the bits from `first_shift` up.
void sort_by_digits(std::span<KeyedIndex> records, std::span<KeyedIndex> scratch, unsigned first_shift,
                    int threads) {
  const std::size_t parts = std::clamp<std::size_t>(records.size() / least_shared, 1,
                                                    static_cast<std::size_t>(std::max(threads, 1)));
  std::vector<Histogram> histograms(parts);
  std::span<KeyedIndex> from = records;
  std::span<KeyedIndex> to = scratch;
  for (unsigned shift = first_shift; shift < 64; shift += digit_bits)
    if (scatter(from, to, shift, histograms)) std::swap(from, to);
  if (from.data() != records.data()) std::copy(from.begin(), from.end(), records.begin());
}

bool has_less_key(const KeyedIndex& a, const KeyedIndex& b) {
  return a.key < b.key;
}

void sort_short(std::span<KeyedIndex> records) {
  if (records.size() == 2) {
    if (has_less_key(records[1], records[0])) std::swap(records[0], records[1]);
  } else {
    std::stable_sort(records.begin(), records.end(), has_less_key);
  }
}

}  // namespace

void sort_by_key(std::span<KeyedIndex> records, std::span<KeyedIndex> scratch, int threads) {
  if (records.size() < least_by_digits) return sort_short(records);
  // The seeds of a piece out of core come along the curve already.
  if (std::is_sorted(records.begin(), records.end(), has_less_key)) return;
  // Sort by enough of the highest digits to separate most records: an even number of passes, which ends in
  // `records`. Runs that agree in these digits are mostly short; long ones are sorted by all digits.
  unsigned passes = 2;
  while (passes * digit_bits < 64 && (records.size() >> (passes * digit_bits - 1)) > 1) passes += 2;
  const unsigned first_shift = passes * digit_bits < 64 ? 64 - passes * digit_bits : 0;
  sort_by_digits(records, scratch, first_shift, threads);
  if (first_shift == 0) return;
  for (std::size_t run = 0; run < records.size();) {
    std::size_t end = run + 1;
    while (end < records.size() && records[end].key >> first_shift == records[run].key >> first_shift) ++end;
    if (end - run >= least_by_digits)
      sort_by_digits(records.subspan(run, end - run), scratch.subspan(run, end - run), 0, threads);
    else if (end - run > 1)
      sort_short(records.subspan(run, end - run));
    run = end;
  }
}

}  // namespace powercell
