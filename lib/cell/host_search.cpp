#include "lib/cell/host_search.hpp"

#include <algorithm>
#include <cmath>

#include "lib/base/vector_copies.hpp"

namespace powercell {
namespace {

/// Seeds nearer than this count as if they were that far.
constexpr double resolution = 1e-145;  // the square root of least_product

double squared_distance(const HostNode& a, const HostNode& b) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double gap = std::max(std::max(a.low[k] - b.high[k], b.low[k] - a.high[k]), 0.0);
    square += gap * gap;
  }
  return square;
}

/// Calls use(child) for the nodes below one of the tree, or the seeds of a leaf.
template <class Use>
void for_children(const PackedTree& tree, std::uint32_t at, std::int32_t level, const Use& use) {
  const auto l = static_cast<std::size_t>(level);
  const std::uint32_t count =
      level == 0 ? static_cast<std::uint32_t>(tree.seeds) : tree.level_offset[l] - tree.level_offset[l - 1];
  const std::uint32_t first = at * PackedTree::fan, end = std::min(first + PackedTree::fan, count);
  for (std::uint32_t child = first; child < end; ++child) use(child);
}

/// most[k] = the largest, over the points y, of |y|^2 less the squared distance of y from box k, whose bounds
/// stand at low_x[k], low_y[k], low_z[k], high_x[k], ... in `box`, one column after the other.
POWERCELL_VECTOR_COPIES void find_most(const std::vector<Point>& points, std::size_t count, const double* box,
                                       double* most) {
  const auto gap = [](double below, double above) {
    const double out = below < above ? above : below;
    return out < 0 ? 0 : out;
  };
  for (const auto [x, y, z] : points) {
    const double square = x * x + y * y + z * z;
    for (std::size_t k = 0; k < count; ++k) {
      const double gap_x = gap(box[k] - x, x - box[k + 3 * count]),
                   gap_y = gap(box[k + count] - y, y - box[k + 4 * count]),
                   gap_z = gap(box[k + 2 * count] - z, z - box[k + 5 * count]);
      const double value = square - (gap_x * gap_x + gap_y * gap_y + gap_z * gap_z);
      most[k] = most[k] < value ? value : most[k];
    }
  }
}

}  // namespace

/// Relative to the seed.
HostNode HostSearch::box_of(const Entry& entry) const {
  const Point seed = position(seed_);
  if (entry.level == seed_level) {
    const Point q = position(scene_.points[entry.at]) - seed;
    return {q, q, scene_.points[entry.at][3]};
  }
  const HostNode& node = scene_.node(entry.at, entry.level);
  return {node.low - seed, node.high - seed, node.weight};
}

/// Of seeds between these squared distances that have no more than this weight.
inline double HostSearch::key_of(double nearest, double farthest, double weight) const {
  // Where the cell's own seed outweighs the others, the distance of the bisector is least at the root of
  // that.
  const double excess = seed_[3] - weight, square = std::max(std::min(excess, farthest), nearest);
  const double offset = square * (1 - 16 * rounding_unit) + excess;
  return offset * (std::fabs(offset) / std::max(square, least_product));
}

void HostSearch::divide_tree(std::uint32_t leaf) {
  constexpr std::size_t most = 128;
  const PackedTree& tree = *scene_.tree;
  const auto top = static_cast<std::int32_t>(tree.levels()) - 1;
  const HostNode &home = scene_.node(leaf, 0),
                 &around = top == 0 ? home : scene_.node(leaf / PackedTree::fan, 1);
  const Point extent = around.high - around.low;
  home_ = leaf;
  near_distance_ = (tree.dimension == 3 ? 0.15 : 0.06) * dot(extent, extent);
  near_.clear();
  rest_.clear();
  nodes_.assign(1, {0, 0, top});
  rest_weight_ = -largest_real;
  while (!nodes_.empty()) {
    const Entry entry = nodes_.back();
    nodes_.pop_back();
    if (!(entry.key <= near_distance_) || near_.size() == most) {
      rest_.push_back(entry);
      rest_weight_ = std::max(rest_weight_, scene_.node(entry.at, entry.level).weight);
    } else if (entry.level == 0) {
      near_.push_back(entry);
    } else {
      for_children(tree, entry.at, entry.level, [&](std::uint32_t child) {
        nodes_.push_back(
            {squared_distance(scene_.node(child, entry.level - 1), home), child, entry.level - 1});
      });
    }
  }
}

void HostSearch::start(std::uint32_t rank) {
  rank_ = rank;
  seed_ = scene_.points[rank];
  seed_[3] -= 4 * least_product;
  horizon_ = 0;
  effort_ = 0;
  if (rank / PackedTree::fan != home_) divide_tree(rank / PackedTree::fan);
  nodes_.clear();
  seeds_.clear();
  queue_.clear();
  for (const Entry& leaf : near_)
    nodes_.push_back({key_of(leaf.key, largest_real, scene_.node(leaf.at, 0).weight), leaf.at, 0});
  if (rest_.empty()) return;
  const auto nearer = [](const Entry& a, const Entry& b) { return a.key < b.key; };
  const double nearest = std::min_element(rest_.begin(), rest_.end(), nearer)->key;
  nodes_.push_back({key_of(nearest, largest_real, rest_weight_), 0, rest_level});
}

/// One round.
void HostSearch::advance(const std::vector<Point>& cell, double radius, double reach) {
  const bool is_first = horizon_ == 0;  // the cell is the region still
  horizon_ = std::max(is_first ? near_distance_ / 4 : 3 * horizon_, least_product);
  const double limit = std::min(horizon_, reach);
  for (Entries near;; near.clear()) {
    take_below(limit, reach, nodes_, near);
    if (near.empty()) break;
    if (!is_first) keep_cutting(near, cell, radius);
    for (const Entry& node : near) open(node, reach);
    effort_ += near.size();
    if (gave_up()) return;
  }
  take_below(limit, reach, seeds_, queue_);
  if (!is_first) keep_cutting(queue_, cell, radius);
  std::sort(queue_.begin(), queue_.end(),
            [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key > b.key : a.at > b.at; });
}

/// Moves entries with keys below `limit` to the end of `taken`, and drops those that are not below `reach`.
void HostSearch::take_below(double limit, double reach, Entries& from, Entries& taken) {
  std::size_t kept = 0;
  for (const Entry& entry : from) {
    if (entry.key < limit)
      taken.push_back(entry);
    else if (entry.key < reach)
      from[kept++] = entry;
  }
  from.resize(kept);
}

void HostSearch::open(const Entry& entry, double reach) {
  const auto add_node = [&](std::uint32_t at, std::int32_t level) {
    const HostNode box = box_of({0, at, level});
    double nearest = 0, farthest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double gap = std::max(std::max(box.low[k], -box.high[k]), 0.0),
                   far = std::max(-box.low[k], box.high[k]);
      nearest += gap * gap;
      farthest += far * far;
    }
    const double key = key_of(nearest, farthest, box.weight);
    if (key < reach) nodes_.push_back({key, at, level});
  };
  if (entry.level == rest_level) {
    for (const Entry& node : rest_) add_node(node.at, node.level);
  } else if (entry.level > 0) {
    for_children(*scene_.tree, entry.at, entry.level,
                 [&](std::uint32_t at) { add_node(at, entry.level - 1); });
  } else {
    for_children(*scene_.tree, entry.at, 0, [&](std::uint32_t j) {
      const std::array<double, 4>& other = scene_.points[j];
      const Point q = position(other) - position(seed_);
      const double square = dot(q, q), key = key_of(square, square, other[3]);
      if (key < reach && j != rank_) seeds_.push_back({key, j, seed_level});
    });
  }
}

/// Keeps the entries of which a seed may cut the cell (docs/mathematics.md (9a)).
void HostSearch::keep_cutting(Entries& entries, const std::vector<Point>& cell, double radius) {
  const std::size_t count = entries.size();
  box_.resize(6 * count);
  least_.resize(count);
  most_.assign(count, -largest_real);
  for (std::size_t k = 0; k < count; ++k) {
    if (entries[k].level == rest_level) continue;
    const HostNode box = box_of(entries[k]);
    const double excess = seed_[3] - box.weight;
    double far = resolution, squares = std::fabs(excess);
    for (std::size_t i = 0; i < 3; ++i) {
      box_[k + i * count] = box.low[i];
      box_[k + (i + 3) * count] = box.high[i];
      const double low = std::fabs(box.low[i]), high = std::fabs(box.high[i]), sum = low + high + 2 * radius;
      far += std::max(low, high);
      squares += sum * sum;
    }
    least_[k] = excess - search_margin / 4 * far * radius - 16 * rounding_unit * squares;
  }
  find_most(cell, count, box_.data(), most_.data());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k)
    if (entries[k].level == rest_level || most_[k] > least_[k]) entries[kept++] = entries[k];
  entries.resize(kept);
}

}  // namespace powercell
