#include "lib/applications/transport/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace powercell {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_share = 1e-13;  // of a seed's supply; less is rounding
constexpr double tie_share = 0.01;     // of the seeds that tie two parts

}  // namespace

Assignment::Assignment(const std::vector<std::vector<double>>& gain, const std::vector<double>& supply,
                       const std::vector<double>& room)
    : gain_(gain),
      supply_(supply),
      parts_(gain.size()),
      seeds_(supply.size()),
      share_(parts_, std::vector<double>(seeds_)),
      excess_(parts_),
      moves_(parts_ * parts_) {
  for (std::size_t p = 0; p < parts_; ++p) excess_[p] = -room[p];
  for (std::uint32_t i = 0; i < seeds_; ++i) {
    std::size_t best = 0;
    for (std::size_t p = 1; p < parts_; ++p)
      if (gain_[p][i] > gain_[best][i]) best = p;
    share_[best][i] = supply_[i];
    excess_[best] += supply_[i];
    enter(best, i);
  }
  const double negligible = 1e-12 * std::accumulate(supply.begin(), supply.end(), 0.0);
  // Each path empties a share or fills a part, so a few paths a seed suffice; rounding cannot make it
  // endless.
  for (std::size_t k = 0; k < 20 * (seeds_ + parts_) && augment(negligible); ++k) {
  }
}

bool Assignment::has_share(std::size_t part, std::uint32_t seed) const {
  return share_[part][seed] > least_share * supply_[seed];
}

void Assignment::enter(std::size_t part, std::uint32_t seed) {
  for (std::size_t q = 0; q < parts_; ++q)
    if (q != part) moves_[part * parts_ + q].push({gain_[part][seed] - gain_[q][seed], seed});
}

const Assignment::Move* Assignment::cheapest(std::size_t from, std::size_t to) {
  Moves& moves = moves_[from * parts_ + to];
  while (!moves.empty() && !has_share(from, moves.top().seed)) moves.pop();
  return moves.empty() ? nullptr : &moves.top();
}

/// Shortest distances (Bellman and Ford) from the part of distance 0, or to it along reversed moves.
void Assignment::relax(std::vector<double>& distance, std::vector<std::size_t>& before, bool reversed) {
  bool changed = true;
  for (std::size_t round = 0; changed && round < parts_; ++round) {
    changed = false;
    for (std::size_t p = 0; p < parts_; ++p)
      for (std::size_t q = 0; q < parts_; ++q) {
        if (p == q || distance[p] == infinite) continue;
        const Move* move = reversed ? cheapest(q, p) : cheapest(p, q);
        if (move == nullptr) continue;
        const double there = distance[p] + move->cost, rounding = 1e-14 * std::abs(distance[q]);
        if (distance[q] != infinite && !(there < distance[q] - rounding)) continue;
        distance[q] = there;
        before[q] = p;
        changed = true;
      }
  }
}

/// Passes mass from the fullest part along the cheapest path to one with room. False when none is too full.
bool Assignment::augment(double negligible) {
  const auto from = static_cast<std::size_t>(std::ranges::max_element(excess_) - excess_.begin());
  if (excess_[from] <= negligible) return false;
  std::vector<double> distance(parts_, infinite);
  std::vector<std::size_t> before(parts_, parts_);
  distance[from] = 0;
  relax(distance, before, false);
  std::size_t to = parts_;
  for (std::size_t q = 0; q < parts_; ++q)
    if (excess_[q] < -negligible && distance[q] < infinite && (to == parts_ || distance[q] < distance[to]))
      to = q;
  if (to == parts_) return false;
  std::vector<std::pair<std::size_t, std::size_t>> path;
  for (std::size_t q = to; q != from; q = before[q]) {
    if (path.size() == parts_) return false;  // rounding has closed a cycle of ties
    path.emplace_back(before[q], q);
  }
  double amount = std::min(excess_[from], -excess_[to]);
  std::vector<std::uint32_t> seed;
  for (const auto& [p, q] : path) {
    seed.push_back(cheapest(p, q)->seed);
    amount = std::min(amount, share_[p][seed.back()]);
  }
  for (std::size_t k = 0; k < path.size(); ++k) {
    const auto& [p, q] = path[k];
    const bool had = has_share(q, seed[k]);
    share_[p][seed[k]] -= amount;
    share_[q][seed[k]] += amount;
    if (!had) enter(q, seed[k]);
  }
  excess_[from] -= amount;
  excess_[to] += amount;
  return true;
}

std::vector<double> Assignment::prices() {
  std::vector<double> price(parts_, infinite);
  std::vector<std::size_t> next(parts_, parts_);
  std::size_t root = 0;
  while (root + 1 < parts_ && std::ranges::all_of(share_[root], [](double m) { return m == 0; })) ++root;
  price[root] = 0;
  relax(price, next, true);
  std::vector<std::pair<std::size_t, std::uint32_t>> ties;
  for (std::size_t p = 0; p < parts_; ++p)
    if (next[p] < parts_)
      if (const Move* tie = cheapest(p, next[p])) ties.emplace_back(next[p], tie->seed);
  for (const auto& [part, seed] : ties)
    share_[part][seed] = std::max(share_[part][seed], tie_share * supply_[seed]);
  return price;
}

}  // namespace powercell
