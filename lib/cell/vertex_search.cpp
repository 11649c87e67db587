#include "lib/cell/vertex_search.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace powercell {
namespace {

/// So many places are kept; then all that is known is forgotten, which costs one search through all seeds.
constexpr std::size_t most_places = std::size_t{1} << 16;

/// Largest relative error of an operation.
template <class Real>
constexpr double unit = std::is_same_v<Real, double> ? rounding_unit : TwoDoubles::rounding;

double as_double(double x) {
  return x;
}
double as_double(const TwoDoubles& x) {
  return x.high;
}
template <class Real>
double size_of(const Real& x) {
  return std::fabs(as_double(x));
}

template <class Real>
Real number_of(double x) {
  if constexpr (std::is_same_v<Real, double>)
    return x;
  else
    return {x, 0};
}
template <class Real>
Real difference(double a, double b) {
  if constexpr (std::is_same_v<Real, double>)
    return a - b;
  else
    return exact_difference(a, b);
}

}  // namespace

template <class Real>
void VertexSearch<Real>::start(std::uint32_t rank) {
  rank_ = rank;
  seed_ = scene_.points[rank];
  if (known_.size() == scene_.nodes.size() && places_.size() < most_places) return;
  known_.assign(scene_.nodes.size(), {});
  places_.clear();
}

template <class Real>
std::optional<std::uint32_t> VertexSearch<Real>::find(const Vector& vertex, double error, std::size_t most) {
  vertex_ = vertex;
  error_ = error;
  most_ = most;
  square_ = {};
  for (const Real& x : vertex) square_ = square_ + x * x;
  best_ = 0;
  nearest_.reset();
  doubtful_.clear();
  places_.push_back({position(seed_), vertex});
  search(0, scene_.tree->levels() - 1);
  return nearest_;
}

/// By the box, and by what is known of the node (docs/mathematics.md (86a), (86b)).
template <class Real>
typename VertexSearch<Real>::Bound VertexSearch<Real>::bound(std::size_t number) const {
  const HostNode& node = scene_.nodes[number];
  const Point low = node.low - position(seed_), high = node.high - position(seed_);
  const double excess = seed_[3] - node.weight;
  double distance = excess, squares = std::fabs(excess), far = 0;
  for (std::size_t k = 0; k < dimension_; ++k) {
    const double x = as_double(vertex_[k]), gap = std::max(std::max(low[k] - x, x - high[k]), 0.0);
    const double size = std::fabs(low[k]) + std::fabs(high[k]) + 2 * std::fabs(x);
    distance += gap * gap - x * x;
    squares += size * size;
    far += std::max(std::fabs(low[k]), std::fabs(high[k]));
  }
  const Real by_box = number_of<Real>(distance - 16 * rounding_unit * squares - 2 * least_product);
  const Known& known = known_[number];
  if (known.place == none) return {by_box, far};
  return {std::max(by_box, bound_by_place(node, known, squares)), far};
}

/// \param squares  bounds the squares of all lengths between the node, the vertex and the cell's seed
template <class Real>
Real VertexSearch<Real>::bound_by_place(const HostNode& node, const Known& known, double squares) const {
  const Place& place = places_[known.place];
  Real across{}, step2{};
  double error = 0;
  for (std::size_t k = 0; k < dimension_; ++k) {
    const Real seeds = difference<Real>(seed_[k], place.seed[k]), vertices = vertex_[k] - place.vertex[k],
               step = seeds + vertices;
    const Real low = difference<Real>(node.low[k], seed_[k]) - vertex_[k],
               high = difference<Real>(node.high[k], seed_[k]) - vertex_[k];
    across = across + std::max(step * low, step * high);
    step2 = step2 + step * step;
    error += (size_of(seeds) + size_of(vertices)) * (std::max(size_of(low), size_of(high)) + size_of(step));
  }
  const Real excess = difference<Real>(seed_[3], node.weight);
  const double margin = 8 * unit<Real> * (error + squares + size_of(known.least)) + 2 * least_product;
  return known.least + excess - square_ - (across + across) - step2 - number_of<Real>(margin);
}

/// Visits the seeds below a node that may take the vertex.
/// \return a lower bound of their differences of power distances
template <class Real>
Real VertexSearch<Real>::search(std::uint32_t at, std::size_t level) {
  const std::size_t node = number(at, level);
  const Real least = level == 0 ? search_leaf(at) : search_children(at, level);
  if (ended_early()) return least;
  const Real excess = difference<Real>(seed_[3], scene_.nodes[node].weight);
  const double margin = 4 * unit<Real> * (size_of(least) + size_of(square_) + size_of(excess));
  known_[node] = {static_cast<std::uint32_t>(places_.size() - 1),
                  least + square_ - excess - number_of<Real>(margin)};
  return least;
}

template <class Real>
bool VertexSearch<Real>::is_clear(const Bound& bound) const {
  return as_double(bound.least) - 2 * bound.far * error_ > best_;
}

template <class Real>
Real VertexSearch<Real>::search_children(std::uint32_t at, std::size_t level) {
  const std::size_t count = scene_.tree->level_offset[level] - scene_.tree->level_offset[level - 1];
  const std::uint32_t first = at * PackedTree::fan,
                      end = std::min(first + PackedTree::fan, static_cast<std::uint32_t>(count));
  std::array<Child, PackedTree::fan> children;  // nearest first
  std::size_t size = 0;
  Real least = number_of<Real>(largest_real);
  for (std::uint32_t child = first; child < end; ++child) {
    const Child here{bound(number(child, level - 1)), child};
    if (is_clear(here.bound)) {
      least = std::min(least, here.bound.least);
      continue;
    }
    std::size_t k = size++;
    for (; k > 0 && here.bound.least < children[k - 1].bound.least; --k) children[k] = children[k - 1];
    children[k] = here;
  }
  for (std::size_t k = 0; k < size && !ended_early(); ++k) {
    const auto& [bound, child] = children[k];
    least = std::min(least, is_clear(bound) ? bound.least : search(child, level - 1));
  }
  return least;
}

template <class Real>
Real VertexSearch<Real>::search_leaf(std::uint32_t at) {
  const std::uint32_t first = at * PackedTree::fan,
                      end = std::min(first + PackedTree::fan, static_cast<std::uint32_t>(scene_.tree->seeds));
  Real least = number_of<Real>(largest_real);
  for (std::uint32_t j = first; j < end; ++j) {
    const std::array<double, 4>& other = scene_.points[j];
    Real value = difference<Real>(seed_[3], other[3]);
    double size = size_of(value), far = 0;
    for (std::size_t k = 0; k < dimension_; ++k) {
      const Real q = difference<Real>(other[k], seed_[k]);
      value = value + q * (q - (vertex_[k] + vertex_[k]));
      size += size_of(q) * (2 * size_of(vertex_[k]) + size_of(q));
      far += size_of(q);
    }
    const double rounding = 8 * unit<Real> * size + 2 * least_product, error = rounding + 2 * far * error_;
    least = std::min(least, value - number_of<Real>(rounding));
    const double here = as_double(value);
    if (j == rank_ || here > error) continue;
    if (here >= -error) {
      doubtful_.push_back(j);
    } else if (here + error < best_) {
      nearest_ = j;
      best_ = here + error;
    }
  }
  return least;
}

template class VertexSearch<double>;
template class VertexSearch<TwoDoubles>;

}  // namespace powercell
