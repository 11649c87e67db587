#include "lib/applications/sampling/apart.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "lib/applications/sampling/nearest.hpp"
#include "lib/base/disjoint_sets.hpp"
#include "lib/base/vectors.hpp"

namespace powercell {
namespace {

using Vec = Vector3<double>;

// Parts below this share of the mean cell are left out: rounding makes parts without area at edges.
constexpr double least_part = 1e-6;

/// Measure, and integral of the position.
struct Moment {
  double measure = 0;
  Vec first{};
  void add(double size, const Vec& centroid) {
    measure += size;
    first = first + size * centroid;
  }
  void add(const Moment& other) {
    measure += other.measure;
    first = first + other.first;
  }
};

class Parts {
 public:
  Parts(const Cells& cells, std::span<const double> positions)
      : cells_(cells),
        positions_(positions),
        d_(static_cast<std::size_t>(cells.dimension)),
        sets_(cells.piece_count()),
        moment_(cells.piece_count()) {
    for (std::uint64_t p = 0; p < cells.piece_count(); ++p) moment_[p] = moment_of(p);
  }

  PartsApart measure() {
    PartsApart result;
    double whole = 0;
    for (const Moment& m : moment_) whole += m.measure;
    const double least = least_part * whole / static_cast<double>(cells_.cell_count());
    double sum = 0;
    for (std::size_t i = 0; i < cells_.cell_count(); ++i) {
      const double apart = measure_of_cell(i, least);
      if (apart > 0) ++result.cells;
      sum += apart;
    }
    if (sum > 0) {
      result.share = sum / whole;
      result.distance = median_distance(sum);
    }
    return result;
  }

 private:
  /// A part apart from its point.
  struct Apart {
    double distance, measure;
  };

  Vec vertex(std::uint64_t v) const {
    const double* x = &cells_.vertices[v * d_];
    return {x[0], x[1], d_ == 3 ? x[2] : 0.0};
  }

  Moment moment_of(std::uint64_t p) const {
    const std::uint64_t begin = cells_.vertex_offset[p], end = cells_.vertex_offset[p + 1];
    Moment m;
    if (begin == end) return m;
    const Vec a = vertex(begin);
    if (cells_.cell_dimension == 2) {
      for (std::uint64_t v = begin + 2; v < end; ++v) {
        const Vec b = vertex(v - 1), c = vertex(v);
        m.add(norm(cross(b - a, c - a)) / 2, (1.0 / 3) * (a + b + c));
      }
      return m;
    }
    for (std::uint64_t f = cells_.face_offset[p]; f < cells_.face_offset[p + 1]; ++f) {
      const auto corner = [&](std::uint64_t k) { return vertex(begin + cells_.loop[k]); };
      const std::uint64_t first = cells_.loop_offset[f];
      for (std::uint64_t k = first + 2; k < cells_.loop_offset[f + 1]; ++k) {
        const Vec b = corner(first), c = corner(k - 1), e = corner(k);
        m.add(std::abs(dot(b - a, cross(c - a, e - a))) / 6, 0.25 * (a + b + c + e));
      }
    }
    return m;
  }

  /// Unites the pieces [begin, end) of a cell that share a facet between regions.
  void connect(std::uint64_t begin, std::uint64_t end) {
    by_region_.clear();
    for (std::uint64_t p = begin; p < end; ++p)
      by_region_.emplace_back(cells_.region[p], static_cast<std::uint32_t>(p));
    std::ranges::sort(by_region_);
    for (std::uint64_t p = begin; p < end; ++p)
      for (std::uint64_t f = cells_.face_offset[p]; f < cells_.face_offset[p + 1]; ++f) {
        const Border& border = cells_.border[f];
        if (border.kind != Border::Kind::interior) continue;
        const auto behind = std::ranges::lower_bound(by_region_, std::pair{border.index, std::uint32_t{0}});
        if (behind != by_region_.end() && behind->first == border.index)
          sets_.unite(static_cast<std::uint32_t>(p), behind->second);
      }
  }

  /// The measure of the parts of cell i apart from its point that are larger than `least`.
  double measure_of_cell(std::size_t i, double least) {
    const std::uint64_t begin = cells_.cell_offset[i], end = cells_.cell_offset[i + 1];
    if (end - begin < 2) return 0;
    connect(begin, end);
    const auto root = [&](std::uint64_t p) { return sets_.root(static_cast<std::uint32_t>(p)); };
    for (std::uint64_t p = begin; p < end; ++p)  // a root comes before the others of its set
      if (root(p) != p) moment_[root(p)].add(moment_[p]);
    std::vector<std::uint64_t> roots;
    for (std::uint64_t p = begin; p < end; ++p)
      if (root(p) == p && moment_[p].measure > least) roots.push_back(p);
    if (roots.size() < 2) return 0;
    const auto distance_to_part = [&](std::uint64_t part, const Vec& x) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::uint64_t p = begin; p < end; ++p)
        if (root(p) == part) nearest = std::min(nearest, norm(nearest_in_piece(cells_, p, x) - x));
      return nearest;
    };
    Vec point{};
    std::copy_n(&positions_[i * d_], d_, point.begin());
    const std::uint64_t own =
        *std::ranges::min_element(roots, {}, [&](std::uint64_t r) { return distance_to_part(r, point); });
    double sum = 0;
    for (const std::uint64_t r : roots) {
      if (r == own) continue;
      const Moment& m = moment_[r];
      sum += m.measure;
      apart_.push_back({distance_to_part(own, (1 / m.measure) * m.first), m.measure});
    }
    return sum;
  }

  /// \param sum  of the measures of the parts apart
  double median_distance(double sum) {
    std::ranges::sort(apart_, {}, &Apart::distance);
    double nearer = 0;
    for (const Apart& one : apart_)
      if ((nearer += one.measure) >= sum / 2) return one.distance;
    return apart_.back().distance;
  }

  const Cells& cells_;
  std::span<const double> positions_;
  std::size_t d_;
  DisjointSets sets_;           // of pieces
  std::vector<Moment> moment_;  // of pieces; of parts, at their roots, once the cell is measured
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_region_;  // region and piece
  std::vector<Apart> apart_;
};

}  // namespace

PartsApart parts_apart(const Cells& cells, std::span<const double> positions) {
  return Parts(cells, positions).measure();
}

}  // namespace powercell
