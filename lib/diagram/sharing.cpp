#include "lib/diagram/sharing.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace powercell {
namespace {

/// The first range of a member whose speed is not known has this part of its most items, and so have the
/// shortest ranges towards the end of what its speed allows.
constexpr std::uint64_t shortest_part = 8;

}  // namespace

Sharing::Sharing(std::uint64_t total, std::uint64_t least, const std::vector<Member>& members)
    : total_(total), least_(std::max<std::uint64_t>(least, 1)) {
  for (const Member& member : members) members_.push_back({member, false});
}

double Sharing::speed_of_others(std::size_t member) const {
  double sum = 0;
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (k != member && members_[k].takes_part) sum += members_[k].speed;
  return sum;
}

std::uint64_t Sharing::size_for(std::size_t member) const {
  const State& own = members_[member];
  const std::uint64_t most = own.most;
  const double others = speed_of_others(member), left = static_cast<double>(total_ - next_);
  if (members_.size() == 1) return most;
  if (own.speed == 0)
    return std::clamp(std::min(most / shortest_part, (total_ - next_) / (4 * members_.size())),
                      std::min(least_, most), most);
  double seconds = std::numeric_limits<double>::infinity();  // of a range
  for (const State& each : members_)
    if (each.takes_part && each.speed > 0)
      seconds = std::min(seconds, static_cast<double>(each.most) / each.speed);
  const double longest = std::min(static_cast<double>(most), own.speed * seconds);
  // Half of what is due to this member, because speeds change.
  const double due = others > 0 ? left * own.speed / (own.speed + others) / 2 : left;
  const auto shortest =
      std::max<double>(static_cast<double>(least_), longest / static_cast<double>(shortest_part));
  return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(std::max(shortest, std::min(longest, due))), 1,
                                   most);
}

Sharing::Range Sharing::take(std::size_t member) {
  State& own = members_[member];
  own.takes_part = true;
  const std::uint64_t size = std::min(size_for(member), total_ - next_);
  const double others = speed_of_others(member);
  const bool too_slow =
      own.speed > 0 && static_cast<double>(size) / own.speed > static_cast<double>(total_ - next_) / others;
  if (size == 0 || (others > 0 && too_slow)) {
    own.takes_part = false;
    return {};
  }
  const std::uint64_t begin = std::exchange(next_, next_ + size);
  return {begin, next_};
}

void Sharing::took(std::size_t member, std::uint64_t items, double seconds) {
  // So that a clock that did not move counts as fast, not as infinitely fast.
  const double measured = static_cast<double>(items) / std::max(seconds, 1e-9);
  double& speed = members_[member].speed;
  speed = speed == 0 ? measured : (speed + measured) / 2;
}

void Sharing::limit(std::size_t member, std::uint64_t most) {
  members_[member].most = std::max<std::uint64_t>(1, std::min(members_[member].most, most));
}

}  // namespace powercell
