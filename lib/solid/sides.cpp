#include "lib/solid/sides.hpp"

namespace powercell {
namespace {

using solid::Side;

class Spreading {
 public:
  explicit Spreading(const SidesInput& input)
      : input_(input), side_(input.one_sided.size(), Side::unknown), bad_(input.one_sided.size(), false) {}

  std::vector<Side> run() {
    for (std::uint32_t rank = 0; rank < side_.size(); ++rank) take_hints(rank);
    for (const std::uint32_t rank : input_.outer) set(rank, Side::outside);
    spread();
    for (std::uint32_t rank = 0; rank < side_.size(); ++rank)
      if (bad_[rank]) side_[rank] = Side::unknown;
    return std::move(side_);
  }

 private:
  void take_hints(std::uint32_t rank) {
    if (input_.hints.seen[rank] & SideHints::outside) set(rank, Side::outside);
    if (input_.hints.seen[rank] & SideHints::inside) set(rank, Side::inside);
  }

  void set(std::uint32_t rank, Side side) {
    if (!input_.one_sided[rank]) return;
    if (side_[rank] == Side::unknown) {
      side_[rank] = side;
      stack_.push_back(rank);
    } else if (side_[rank] != side) {
      bad_[rank] = true;
    }
  }

  void spread() {
    while (!stack_.empty()) {
      const std::uint32_t rank = stack_.back();
      stack_.pop_back();
      if (bad_[rank]) continue;
      for (const std::uint32_t neighbor : input_.neighbors(rank)) set(neighbor, side_[rank]);
    }
  }

  const SidesInput& input_;
  std::vector<Side> side_;
  std::vector<bool> bad_;
  std::vector<std::uint32_t> stack_;
};

}  // namespace

std::vector<solid::Side> find_sides(const SidesInput& input) {
  return Spreading(input).run();
}

}  // namespace powercell
