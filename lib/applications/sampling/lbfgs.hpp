/// \file
/// The memory of limited-memory BFGS.
#pragma once

#include <cstddef>
#include <vector>

namespace powercell {

/// Approximates the inverse Hessian H from the last steps and changes of the gradient (Nocedal 1980).
class LbfgsMemory {
 public:
  /// The direction -H g by the two-loop recursion.
  /// \param gradient          g
  /// \param inverse_diagonal  the diagonal of the initial H, (37)
  std::vector<double> direction(const std::vector<double>& gradient,
                                const std::vector<double>& inverse_diagonal) const;
  /// Adds a step and the change of the gradient over it, unless their product (the curvature) is not
  /// positive.
  void add(std::vector<double> step, std::vector<double> change);
  void forget() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

 private:
  static constexpr std::size_t most_pairs = 7;
  struct Pair {
    std::vector<double> step, change;
    double curvature;  // their product
  };
  std::vector<Pair> pairs_;  // oldest first
};

}  // namespace powercell
