#include "lib/solid/sides.hpp"

#include <algorithm>

namespace powercell {
namespace {

using solid::Side;

class Spreading {
 public:
  explicit Spreading(const SidesInput& input) : input_(input), side_(input.one_sided.size(), Side::unknown) {}

  std::vector<Side> run() {
    for (std::uint32_t rank = 0; rank < side_.size(); ++rank) {
      if (input_.hints.seen[rank] & SideHints::outside) set(rank, Side::outside);
      if (input_.hints.seen[rank] & SideHints::inside) set(rank, Side::inside);
    }
    for (const std::uint32_t rank : input_.outer) set(rank, Side::outside);
    spread();
    for (std::uint32_t rank = 0; rank < side_.size(); ++rank)
      if (input_.one_sided[rank] && side_[rank] == Side::unknown && is_out_of_sight(rank))
        set(rank, Side::outside);
    spread();
    if (contradiction_) std::fill(side_.begin(), side_.end(), Side::unknown);
    return std::move(side_);
  }

 private:
  void spread() {
    while (!stack_.empty()) {
      const std::uint32_t rank = stack_.back();
      stack_.pop_back();
      for (const std::uint32_t neighbor : input_.neighbors(rank)) set(neighbor, side_[rank]);
    }
  }

  /// Whether a neighbour of a cell knows its own sides, but has nothing to say about the cell.
  bool is_out_of_sight(std::uint32_t rank) const {
    const std::span<const std::uint32_t> neighbors = input_.neighbors(rank);
    return std::any_of(neighbors.begin(), neighbors.end(), [&](std::uint32_t neighbor) {
      return side_[neighbor] != Side::unknown || (input_.hints.seen[neighbor] & SideHints::looked);
    });
  }

  void set(std::uint32_t rank, Side side) {
    if (!input_.one_sided[rank]) return;
    if (side_[rank] == Side::unknown) {
      side_[rank] = side;
      stack_.push_back(rank);
    }
    contradiction_ = contradiction_ || side_[rank] != side;
  }

  const SidesInput& input_;
  std::vector<Side> side_;
  std::vector<std::uint32_t> stack_;
  bool contradiction_ = false;
};

}  // namespace

std::vector<solid::Side> find_sides(const SidesInput& input) {
  return Spreading(input).run();
}

}  // namespace powercell
