/// \file
/// Weights to start from, by a transport with an entropy.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lib/applications/transport/phases.hpp"
#include "lib/applications/transport/soft_transport.hpp"

namespace powercell {

/// Solves a transport with an entropy between seeds and points that stand for a domain, which may be in
/// parts, while the entropy decreases, from few clusters of seeds to all; (31d), (31e). Seeds are moved and
/// scaled to the mean and extent of the points: that changes their weights by a known function, and avoids
/// large numbers for seeds far away.
class SoftStart {
 public:
  /// Gives about as many points, part by part; at least one in each.
  using Points = std::function<std::vector<Weighted>(std::size_t)>;

  /// \param positions  n x d; kept by reference
  /// \param mass       n, positive
  /// \param threads    as in Options
  SoftStart(std::size_t d, Points points, std::span<const double> positions, std::span<const double> mass,
            int threads);

  void solve();
  /// (31d), for the seeds as given.
  Vector weights() const;
  /// The masses of the seeds in the parts.
  std::vector<PartShare> shares() { return std::move(shares_); }

 private:
  /// Mean and standard deviation.
  struct Spread {
    std::vector<double> mean;
    double deviation = 0;
  };
  static Spread spread_of(std::span<const Weighted> all, std::size_t d);
  void set_points(std::size_t seeds);
  void cool(Weighted& level, double resolved);
  double to_points(const Weighted& seeds);
  void to_seeds(Weighted& seeds, bool balanced);
  std::vector<double> prices(const std::vector<std::vector<double>>& gain, const std::vector<double>& mass);

  std::size_t d_;
  int threads_;
  Points give_points_;
  std::span<const double> positions_;
  Spread of_domain_;
  double scale_ = 1, heat_ = 0;
  std::vector<Weighted> levels_;  // from the finest to the coarsest
  std::vector<Weighted> points_;  // per part
  std::vector<double> room_;      // per part: its share of the domain's measure
  std::vector<PartShare> shares_;
};

}  // namespace powercell
