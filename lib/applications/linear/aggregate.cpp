#include <algorithm>
#include <cmath>

#include "lib/applications/linear/multilevel.hpp"

namespace powercell {
namespace {

constexpr std::int32_t unassigned = -1;
// An entry couples strongly if it is at least this part of the largest of its row, on the finest level;
// halved on each coarser one.
constexpr double finest_threshold = 0.25;

/// Marks the entries that are at least `threshold` times the largest of their row or of their column.
std::vector<char> strong_entries(const SparseRows& matrix, double threshold) {
  Vector largest = Vector::Zero(matrix.rows());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry)
      if (entry.col() != i) largest[i] = std::max(largest[i], -entry.value());
  std::vector<char> strong(static_cast<std::size_t>(matrix.nonZeros()));
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry, ++k)
      strong[k] = entry.col() != i && -entry.value() > 0 &&
                  -entry.value() >= threshold * std::min(largest[i], largest[entry.col()]);
  return strong;
}

class Aggregator {
 public:
  Aggregator(const SparseRows& matrix, Aggregates& out) : matrix_(matrix), out_(out) {
    out_.of.assign(static_cast<std::size_t>(matrix.rows()), unassigned);
  }

  /// Disjoint neighbourhoods first; then the remaining unknowns join a neighbour's aggregate; what is left
  /// makes aggregates of its own.
  void run() {
    const auto n = static_cast<std::int32_t>(matrix_.rows());
    for (std::int32_t i = 0; i < n; ++i)
      if (is_free(i) && all_neighbours_free(i)) join(i);
    const std::vector<std::int32_t> first = out_.of;
    for (std::int32_t i = 0; i < n; ++i)
      if (is_free(i)) attach(i, first);
    for (std::int32_t i = 0; i < n; ++i)
      if (is_free(i)) join(i);
  }

 private:
  template <class Body>
  void for_strong(std::int32_t i, const Body& body) const {
    const std::int32_t* const outer = matrix_.outerIndexPtr();
    for (std::int32_t k = outer[i]; k < outer[i + 1]; ++k)
      if (out_.strong[static_cast<std::size_t>(k)]) body(matrix_.innerIndexPtr()[k], matrix_.valuePtr()[k]);
  }
  bool is_free(std::int32_t i) const { return out_.of[static_cast<std::size_t>(i)] == unassigned; }
  bool all_neighbours_free(std::int32_t i) const {
    bool all = true;
    for_strong(i, [&](std::int32_t j, double) { all = all && is_free(j); });
    return all;
  }
  /// Makes an aggregate of i and its free strong neighbours.
  void join(std::int32_t i) {
    out_.of[static_cast<std::size_t>(i)] = out_.count;
    for_strong(i, [&](std::int32_t j, double) {
      if (is_free(j)) out_.of[static_cast<std::size_t>(j)] = out_.count;
    });
    ++out_.count;
  }
  /// Adds i to the aggregate of the neighbour to which it is coupled most strongly.
  void attach(std::int32_t i, const std::vector<std::int32_t>& first) {
    double best = 0;
    for_strong(i, [&](std::int32_t j, double value) {
      if (first[static_cast<std::size_t>(j)] == unassigned || -value <= best) return;
      best = -value;
      out_.of[static_cast<std::size_t>(i)] = first[static_cast<std::size_t>(j)];
    });
  }

  const SparseRows& matrix_;
  Aggregates& out_;
};

}  // namespace

Aggregates aggregate(const SparseRows& matrix, int level) {
  Aggregates result;
  result.strong = strong_entries(matrix, finest_threshold * std::pow(0.5, level));
  Aggregator(matrix, result).run();
  return result;
}

}  // namespace powercell
