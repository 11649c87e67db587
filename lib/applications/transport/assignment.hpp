/// \file
/// The linear program that shares the masses of seeds among the parts of a domain.
#pragma once

#include <cstdint>
#include <queue>
#include <vector>

namespace powercell {

/// Maximises sum over p, i of gain_p(i) share_p(i) with sum_p share_p(i) = supply(i), sum_i share_p(i) =
/// room(p), share >= 0, by shortest augmenting paths between the parts: each seed starts where it gains most,
/// and parts with too much pass seeds on along the path that costs least.
class Assignment {
 public:
  /// \param gain    part by part, a value for each seed; kept by reference
  /// \param supply  > 0, per seed; kept by reference
  /// \param room    per part; has the same sum
  Assignment(const std::vector<std::vector<double>>& gain, const std::vector<double>& supply,
             const std::vector<double>& room);

  const std::vector<std::vector<double>>& share() const { return share_; }
  /// Prices of the parts at which each seed gains most where it has a share. Adds a small share of the seed
  /// that ties two parts, along a tree of the parts. Infinite for a part that no seed is in.
  std::vector<double> prices();

 private:
  struct Move {
    double cost;  ///< gain lost by a unit of mass
    std::uint32_t seed;
    bool operator>(const Move& other) const { return cost > other.cost; }
  };
  using Moves = std::priority_queue<Move, std::vector<Move>, std::greater<>>;

  bool has_share(std::size_t part, std::uint32_t seed) const;
  void enter(std::size_t part, std::uint32_t seed);
  const Move* cheapest(std::size_t from, std::size_t to);
  void relax(std::vector<double>& distance, std::vector<std::size_t>& before, bool reversed);
  bool augment(double negligible);

  const std::vector<std::vector<double>>& gain_;
  const std::vector<double>& supply_;
  std::size_t parts_, seeds_;
  std::vector<std::vector<double>> share_;
  std::vector<double> excess_;
  std::vector<Moves> moves_;  // from part to part, row-major; entries of seeds that left are dropped late
};

}  // namespace powercell
