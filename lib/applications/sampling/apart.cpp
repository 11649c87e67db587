#include "lib/applications/sampling/apart.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "lib/applications/sampling/nearest.hpp"
#include "lib/base/disjoint_sets.hpp"

namespace powercell {
namespace {

using Vec = Vector3<double>;

// Parts below this share of the mean cell are left out: rounding makes parts without area at edges.
constexpr double least_part = 1e-6;

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
    double whole = 0;
    for (const Moment& m : moment_) whole += m.measure;
    PartsTally tally(whole, cells_.cell_count());
    for (std::size_t i = 0; i < cells_.cell_count(); ++i) add_cell(i, tally);
    return tally.result();
  }

 private:
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

  void add_cell(std::size_t i, PartsTally& tally) {
    const std::uint64_t begin = cells_.cell_offset[i], end = cells_.cell_offset[i + 1];
    if (end - begin < 2) return;
    connect(begin, end);
    const auto root = [&](std::uint64_t p) { return sets_.root(static_cast<std::uint32_t>(p)); };
    for (std::uint64_t p = begin; p < end; ++p)  // a root comes before the others of its set
      if (root(p) != p) moment_[root(p)].add(moment_[p]);
    std::vector<std::uint64_t> roots;
    std::vector<Moment> parts;
    for (std::uint64_t p = begin; p < end; ++p) {
      if (root(p) != p) continue;
      roots.push_back(p);
      parts.push_back(moment_[p]);
    }
    Vec point{};
    std::copy_n(&positions_[i * d_], d_, point.begin());
    tally.add_cell(parts, point, [&](std::size_t part, const Vec& x) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::uint64_t p = begin; p < end; ++p)
        if (root(p) == roots[part]) nearest = std::min(nearest, norm(nearest_in_piece(cells_, p, x) - x));
      return nearest;
    });
  }

  const Cells& cells_;
  std::span<const double> positions_;
  std::size_t d_;
  DisjointSets sets_;           // of pieces
  std::vector<Moment> moment_;  // of pieces; of parts, at their roots, once the cell is measured
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_region_;  // region and piece
};

}  // namespace

PartsTally::PartsTally(double whole, std::size_t n)
    : whole_(whole), least_(least_part * whole / static_cast<double>(n)) {}

void PartsTally::add_cell(std::span<const Moment> parts, const Vec& point,
                          const std::function<double(std::size_t, const Vec&)>& distance) {
  std::vector<std::size_t> large;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].measure > least_) large.push_back(k);
  if (large.size() < 2) return;
  const std::size_t own =
      *std::ranges::min_element(large, {}, [&](std::size_t part) { return distance(part, point); });
  for (const std::size_t part : large) {
    if (part == own) continue;
    const double measure = parts[part].measure;
    apart_.push_back({distance(own, (1 / measure) * parts[part].first), measure});
  }
  ++result_.cells;
}

PartsApart PartsTally::result() {
  double sum = 0, nearer = 0;
  for (const Apart& one : apart_) sum += one.measure;
  if (sum > 0) result_.share = sum / whole_;
  std::ranges::sort(apart_, {}, &Apart::distance);
  for (const Apart& one : apart_) {
    result_.distance = one.distance;
    if ((nearer += one.measure) >= sum / 2) break;
  }
  return result_;
}

PartsApart parts_apart(const Cells& cells, std::span<const double> positions) {
  return Parts(cells, positions).measure();
}

}  // namespace powercell
