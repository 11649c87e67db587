/// \file
/// Least and soft least power distances of a point from a set of seeds.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace powercell {

/// (1)
inline double power_distance(std::span<const double> positions, std::span<const double> weights,
                             std::size_t d, std::uint32_t seed, const std::array<double, 3>& x) {
  double square = 0;
  for (std::size_t c = 0; c < d; ++c) {
    const double q = x[c] - positions[seed * d + c];
    square += q * q;
  }
  return square - weights[seed];
}

/// A tree of boxes of seeds. A box has an affine function that its weights do not exceed: weights of a
/// transport that moves seeds far vary over a box by much more than they deviate from that.
class PowerTree {
 public:
  using Point = std::array<double, 3>;

  /// \param positions  n x d; kept by reference
  /// \param weights    n; kept by reference
  /// \param seeds      those of the set; not empty
  PowerTree(std::span<const double> positions, std::span<const double> weights, std::size_t d,
            std::vector<std::uint32_t> seeds)
      : positions_(positions), weights_(weights), d_(d), seeds_(std::move(seeds)) {
    build(0, seeds_.size());
  }

  struct Nearest {
    std::uint32_t seed;
    double power;
  };
  /// The seed with the least power distance, one of them if several have it.
  Nearest nearest(const Point& x) const {
    Nearest best{seeds_[0], std::numeric_limits<double>::infinity()};
    visit(
        0, 0, seeds_.size(), x, [&] { return best.power; },
        [&](std::uint32_t seed) {
          const double power = distance(seed, x);
          if (power < best.power) best = {seed, power};
        });
    return best;
  }
  double least(const Point& x) const { return nearest(x).power; }

  /// Calls visitor(seed, power distance) for all seeds with a power distance below `most`, and possibly for
  /// others.
  template <class Visitor>
  void near(const Point& x, double most, const Visitor& visitor) const {
    visit(
        0, 0, seeds_.size(), x, [&] { return most; },
        [&](std::uint32_t seed) { visitor(seed, distance(seed, x)); });
  }

 private:
  static constexpr std::size_t leaf = 8;
  struct Node {
    Point low{}, high{}, slope{};
    double weight = -std::numeric_limits<double>::infinity();  ///< the largest, less slope·p
    std::size_t right = 0;  ///< of an inner node; its left child follows it
  };

  double distance(std::uint32_t seed, const Point& x) const {
    return power_distance(positions_, weights_, d_, seed, x);
  }
  double coordinate(std::uint32_t seed, std::size_t c) const { return positions_[seed * d_ + c]; }
  auto iterator(std::size_t k) { return seeds_.begin() + static_cast<std::ptrdiff_t>(k); }

  std::size_t build(std::size_t first, std::size_t last) {
    const std::size_t at = nodes_.size();
    nodes_.emplace_back();
    Node node;
    std::size_t longest = 0;
    for (std::size_t c = 0; c < d_; ++c) {
      const auto [low, high] = std::minmax_element(
          iterator(first), iterator(last),
          [&](std::uint32_t a, std::uint32_t b) { return coordinate(a, c) < coordinate(b, c); });
      node.low[c] = coordinate(*low, c);
      node.high[c] = coordinate(*high, c);
      if (node.high[c] - node.low[c] > node.high[longest] - node.low[longest]) longest = c;
    }
    fit(first, last, node);
    if (last - first > leaf) {
      const std::size_t middle = (first + last) / 2;
      std::nth_element(
          iterator(first), iterator(middle), iterator(last),
          [&](std::uint32_t a, std::uint32_t b) { return coordinate(a, longest) < coordinate(b, longest); });
      build(first, middle);
      node.right = build(middle, last);
    }
    nodes_[at] = node;
    return at;
  }

  /// Fits the affine function by least squares.
  void fit(std::size_t first, std::size_t last, Node& node) const {
    using Vec = Eigen::Vector3d;
    const auto from_corner = [&](std::uint32_t seed) {
      Vec u = Vec::Zero();
      for (std::size_t c = 0; c < d_; ++c)
        u[static_cast<Eigen::Index>(c)] = coordinate(seed, c) - node.low[c];
      return u;
    };
    Vec mean = Vec::Zero();
    double weight = 0;
    for (std::size_t k = first; k < last; ++k) {
      mean += from_corner(seeds_[k]) / static_cast<double>(last - first);
      weight += weights_[seeds_[k]] / static_cast<double>(last - first);
    }
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    Vec product = Vec::Zero();
    for (std::size_t k = first; k < last; ++k) {
      const Vec u = from_corner(seeds_[k]) - mean;
      square += u * u.transpose();
      product += (weights_[seeds_[k]] - weight) * u;
    }
    const double trace = square.trace();
    square.diagonal().array() += trace > 0 ? 1e-9 * trace : 1;  // for seeds in a plane or on a line
    const Vec slope = square.ldlt().solve(product);
    if (slope.allFinite()) std::copy_n(slope.data(), 3, node.slope.begin());
    for (std::size_t k = first; k < last; ++k) {
      double rest = weights_[seeds_[k]];
      for (std::size_t c = 0; c < d_; ++c) rest -= node.slope[c] * coordinate(seeds_[k], c);
      node.weight = std::max(node.weight, rest);
    }
  }

  /// A bound from below. With slope b, |x - p|² - b·p = |p - (x + b/2)|² - b·x - |b|²/4.
  double bound(const Node& node, const Point& x) const {
    double square = 0;
    for (std::size_t c = 0; c < d_; ++c) {
      const double half = node.slope[c] / 2, y = x[c] + half;
      const double away = std::max({node.low[c] - y, y - node.high[c], 0.0});
      square += away * away - half * (2 * x[c] + half);
    }
    return square - node.weight;
  }

  template <class Most, class Visitor>
  void visit(std::size_t at, std::size_t first, std::size_t last, const Point& x, const Most& most,
             const Visitor& visitor) const {
    const Node& node = nodes_[at];
    if (bound(node, x) >= most()) return;
    if (node.right == 0) {
      for (std::size_t k = first; k < last; ++k) visitor(seeds_[k]);
      return;
    }
    const std::size_t middle = (first + last) / 2;
    const bool left_first = bound(nodes_[at + 1], x) <= bound(nodes_[node.right], x);
    if (left_first) visit(at + 1, first, middle, x, most, visitor);
    visit(node.right, middle, last, x, most, visitor);
    if (!left_first) visit(at + 1, first, middle, x, most, visitor);
  }

  std::span<const double> positions_, weights_;
  std::size_t d_;
  std::vector<std::uint32_t> seeds_;
  std::vector<Node> nodes_;
};

}  // namespace powercell
