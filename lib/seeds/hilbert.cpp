#include "lib/seeds/hilbert.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "lib/base/memory.hpp"
#include "lib/base/radix_sort.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

constexpr std::size_t short_run = 8;  // points of a leaf of the packed tree: their order hardly matters
constexpr std::size_t least_shared = 65536;  // points; fewer are faster on one thread

template <int D>
struct Bounds {
  std::array<double, D> low, high;
};

/// Maps a bounding box to grid cells. All axes have the scale of the longest side, so cells are cubic.
template <int D>
struct Grid {
  std::array<double, D> low{};
  double side = 0;
  double unit = 1;  // 1/2 where the side itself would overflow

  explicit Grid(const Bounds<D>& box) {
    for (std::size_t k = 0; k < D; ++k)
      if (!std::isfinite(box.high[k] - box.low[k])) unit = 0.5;
    for (std::size_t k = 0; k < D; ++k) {
      low[k] = box.low[k] * unit;
      side = std::max(side, box.high[k] * unit - low[k]);
    }
  }
  std::uint64_t key(const double* point) const {
    constexpr double cells = static_cast<double>(std::uint32_t{1} << hilbert_bits<D>);
    std::array<std::uint32_t, D> cell;
    for (std::size_t k = 0; k < D; ++k) {
      // Divide: the reciprocal of a side below the smallest normal number overflows.
      const double t = (point[k] * unit - low[k]) / side * cells;
      cell[k] = static_cast<std::uint32_t>(std::min(t, cells - 1));
    }
    return hilbert_key<D>(cell);
  }
};

template <int D>
class Orderer {
 public:
  Orderer(std::span<const double> points, int threads) : points_(points), threads_(threads) {
    resize_populated(records_, points.size() / D, threads);
    resize_populated(scratch_, records_.size(), threads);
  }

  std::vector<std::uint32_t> order() {
    for_ranges(records_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) records_[k].index = static_cast<std::uint32_t>(k);
    });
    sort_run(0, records_.size());
    std::vector<std::uint32_t> indices(records_.size());
    for_ranges(records_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) indices[k] = records_[k].index;
    });
    return indices;
  }

 private:
  const double* point(const KeyedIndex& r) const { return &points_[std::size_t{r.index} * D]; }

  template <class Body>
  void for_ranges(std::size_t count, const Body& body) {
    parallel_for(threads_for(count, threads_, least_shared), count, body);
  }

  Bounds<D> bounds(std::size_t first, std::size_t last) {
    Bounds<D> all;
    std::copy_n(point(records_[first]), D, all.low.begin());
    all.high = all.low;
    std::mutex mutex;
    for_ranges(last - first, [&](std::size_t begin, std::size_t end) {
      Bounds<D> box = {all.low, all.low};
      std::copy_n(point(records_[first + begin]), D, box.low.begin());
      box.high = box.low;
      for (std::size_t r = first + begin; r < first + end; ++r)
        for (std::size_t k = 0; k < D; ++k) {
          box.low[k] = std::min(box.low[k], point(records_[r])[k]);
          box.high[k] = std::max(box.high[k], point(records_[r])[k]);
        }
      const std::lock_guard lock(mutex);
      for (std::size_t k = 0; k < D; ++k) {
        all.low[k] = std::min(all.low[k], box.low[k]);
        all.high[k] = std::max(all.high[k], box.high[k]);
      }
    });
    return all;
  }

  /// Orders the records [first, last), which are in ascending order of index. Each run of equal keys is
  /// ordered again by the grid of its own bounding box. The points at the two ends of the longest side have
  /// different keys, so runs shrink until they are short or at one position. The side shrinks by
  /// 2^hilbert_bits each time, so the exponent range of double limits the depth to about a hundred.
  void sort_run(std::size_t first, std::size_t last) {
    if (last - first <= short_run) return sort_short(first, last);
    const Grid<D> grid(bounds(first, last));
    if (!(grid.side > 0)) return;
    for_ranges(last - first, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = first + begin; r < first + end; ++r)
        records_[r].key = grid.key(point(records_[r]));
    });
    const std::size_t count = last - first;
    sort_by_key(std::span(records_).subspan(first, count), std::span(scratch_).subspan(first, count),
                threads_);
    for (std::size_t run = first; run < last;) {
      std::size_t end = run + 1;
      while (end < last && records_[end].key == records_[run].key) ++end;
      if (end - run > 1) sort_run(run, end);
      run = end;
    }
  }

  void sort_short(std::size_t first, std::size_t last) {
    const auto less = [&](const KeyedIndex& a, const KeyedIndex& b) {
      for (int k = 0; k < D; ++k)
        if (point(a)[k] != point(b)[k]) return point(a)[k] < point(b)[k];
      return a.index < b.index;
    };
    std::sort(records_.begin() + static_cast<std::ptrdiff_t>(first),
              records_.begin() + static_cast<std::ptrdiff_t>(last), less);
  }

  std::span<const double> points_;
  int threads_;
  std::vector<KeyedIndex> records_, scratch_;
};

template <int D>
std::vector<std::uint64_t> keys_in(std::span<const double> points, const Bounds<D>& box, int threads) {
  const Grid<D> grid(box);
  std::vector<std::uint64_t> keys(points.size() / D);
  if (!(grid.side > 0)) return keys;
  parallel_for(threads_for(keys.size(), threads, least_shared), keys.size(),
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) keys[i] = grid.key(&points[i * D]);
               });
  return keys;
}

template <int D>
Bounds<D> bounds_from(std::span<const double> low, std::span<const double> high) {
  Bounds<D> box;
  std::copy_n(low.begin(), D, box.low.begin());
  std::copy_n(high.begin(), D, box.high.begin());
  return box;
}

}  // namespace

std::vector<std::uint32_t> hilbert_order(std::span<const double> points, int dimension, int threads) {
  if (points.empty()) return {};
  return dimension == 2 ? Orderer<2>(points, threads).order() : Orderer<3>(points, threads).order();
}

std::vector<std::uint64_t> hilbert_keys(std::span<const double> points, int dimension,
                                        std::span<const double> low, std::span<const double> high,
                                        int threads) {
  if (points.empty()) return {};
  return dimension == 2 ? keys_in(points, bounds_from<2>(low, high), threads)
                        : keys_in(points, bounds_from<3>(low, high), threads);
}

}  // namespace powercell
