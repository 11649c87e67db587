/// \file
/// Sums and extremes over all seeds of a transport, from those of this process.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/applications/linear/laplacian.hpp"

namespace powercell {

/// In one process the seeds here are all. Where seeds are on several ranks, all ranks call the same functions
/// in the same order and get the same bits: decisions that follow from these are the same on all.
class AllSeeds {
 public:
  AllSeeds() = default;
  AllSeeds(const AllSeeds&) = delete;
  AllSeeds& operator=(const AllSeeds&) = delete;
  virtual ~AllSeeds() = default;

  /// Value by value, over all ranks.
  /// \param here  as many on each
  virtual std::vector<double> sums(std::vector<double> here) const { return here; }
  /// Value by value, over all ranks.
  /// \param here  as many on each
  virtual std::vector<double> greatest(std::vector<double> here) const { return here; }

  double sum(double here) const { return sums({here})[0]; }
  std::size_t count(std::size_t here) const {
    return static_cast<std::size_t>(sum(static_cast<double>(here)));
  }
  bool any(bool here) const { return greatest({here ? 1.0 : 0.0})[0] > 0; }

  /// Of a value for each seed here, of which there may be none.
  template <class Values>
  double sum_of(const Values& here) const {
    return sum(here.size() > 0 ? here.sum() : 0.0);
  }
  double dot(const Vector& a, const Vector& b) const { return sum(a.dot(b)); }
  double norm(const Vector& here) const { return std::sqrt(sum(here.squaredNorm())); }
  /// -infinity without seeds.
  template <class Values>
  double greatest_of(const Values& here) const {
    return greatest({here.size() > 0 ? here.maxCoeff() : -std::numeric_limits<double>::infinity()})[0];
  }
  template <class Values>
  double least_of(const Values& here) const {
    return -greatest_of(-here);
  }
};

}  // namespace powercell
