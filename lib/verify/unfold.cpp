#include "lib/verify/unfold.hpp"

#include <cmath>
#include <map>
#include <utility>

namespace powercell {
namespace {

using Coordinates = Period::Coordinates;

class Unfolder {
 public:
  Unfolder(const SeedsView& seeds, std::span<const double> wrapped, const Period& period, Unfolded& out)
      : d_(static_cast<std::size_t>(seeds.dimension)),
        given_(seeds.positions),
        wrapped_(wrapped),
        period_(period),
        out_(out) {}

  void move_cell(std::size_t i) {
    const Cells& cells = out_.cells;
    for (std::uint64_t v = cells.vertex_offset[cells.cell_offset[i]];
         v < cells.vertex_offset[cells.cell_offset[i + 1]]; ++v)
      for (std::size_t c = 0; c < d_; ++c) out_.cells.vertices[v * d_ + c] += moved(i, c);
    for (std::size_t c = 0; c < d_; ++c) out_.measures.centroid[i * d_ + c] += moved(i, c);
  }

  /// The index of the image of seed j that a face of cell i names.
  std::uint32_t image(std::size_t i, std::uint32_t j, const Shift& shift) {
    const Coordinates by = period_.sum_given(shift);
    Coordinates there{}, here{};
    for (std::size_t c = 0; c < d_; ++c) {
      there[c] = given_[j * d_ + c] + by[c] + moved(i, c);
      here[c] = wrapped_[j * d_ + c];
    }
    const Coordinates to = period_.fraction(there.data()), from = period_.fraction(here.data());
    Shift reduced{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(period_.count()); ++k)
      reduced[k] = static_cast<std::int32_t>(std::lround(to[k] - from[k]));
    if (reduced == Shift{}) return j;
    const auto [found, is_new] =
        known_.emplace(std::pair(j, reduced), static_cast<std::uint32_t>(out_.weights.size()));
    if (is_new) {
      const Coordinates place = period_.moved(here.data(), reduced);
      out_.positions.insert(out_.positions.end(), place.begin(), place.begin() + static_cast<long>(d_));
      out_.weights.push_back(out_.weights[j]);
    }
    return found->second;
  }

 private:
  double moved(std::size_t i, std::size_t c) const { return wrapped_[i * d_ + c] - given_[i * d_ + c]; }

  std::size_t d_;
  std::span<const double> given_, wrapped_;
  const Period& period_;
  Unfolded& out_;
  std::map<std::pair<std::uint32_t, Shift>, std::uint32_t> known_;
};

}  // namespace

Unfolded unfold(const Measures& measures, const Cells& cells, const SeedsView& seeds,
                std::span<const double> wrapped, const Period& period) {
  Unfolded out{measures, cells, seeds.dimension, {wrapped.begin(), wrapped.end()}, {}};
  out.cells.shift.clear();
  out.weights.assign(seeds.weights.begin(), seeds.weights.end());
  out.weights.resize(seeds.size());
  Unfolder unfolder(seeds, wrapped, period, out);
  for (std::size_t i = 0; i < cells.cell_count(); ++i) {
    unfolder.move_cell(i);
    for (std::uint64_t f = cells.face_offset[cells.cell_offset[i]];
         f < cells.face_offset[cells.cell_offset[i + 1]]; ++f) {
      Border& border = out.cells.border[f];
      if (border.kind == Border::Kind::wall) border.index = unfolder.image(i, border.index, cells.shift[f]);
    }
  }
  return out;
}

}  // namespace powercell
