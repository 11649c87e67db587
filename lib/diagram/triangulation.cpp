#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <powercell/diagram.hpp>
#include <powercell/triangulation.hpp>

#include "kernels/layout.h"
#include "lib/base/float_environment.hpp"
#include "lib/base/text.hpp"
#include "lib/base/threads.hpp"
#include "lib/cell/host_clip.hpp"
#include "lib/collect/dual.hpp"
#include "lib/diagram/state.hpp"
#include "lib/domain/frame.hpp"
#include "lib/scene/scene.hpp"
#include "lib/seeds/packed_tree.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {
namespace {

/// Half the side of the box for the device, in extents of the seeds. Few inner cells leave it.
constexpr double near_half_side = 2;
/// The same for the box on the host.
constexpr double far_half_side = 0x1p80;

struct Extent {
  std::vector<double> middle;
  double size = 0;  ///< largest side of the bounding box

  explicit Extent(const SeedsView& seeds) {
    const auto d = static_cast<std::size_t>(seeds.dimension);
    for (std::size_t k = 0; k < d; ++k) {
      double low = seeds.positions[k], high = low;
      for (std::size_t at = k; at < seeds.positions.size(); at += d) {
        low = std::min(low, seeds.positions[at]);
        high = std::max(high, seeds.positions[at]);
      }
      middle.push_back(low + (high - low) / 2);
      size = std::max(size, high - low);
    }
  }

  /// \throw Error invalid_argument if measures of the boxes would leave the range of doubles
  void check() const {
    double near = 0, far = 0;
    for (const double x : middle) {
      near = std::max(near, std::abs(x) + near_half_side * size);
      far = std::max(far, std::abs(x) + far_half_side * size);
    }
    if (near >= 1e-100 && far <= 1e100) return;
    throw Error(ErrorCode::invalid_argument, "the seeds extend over " + digits(size, 3) +
                                                 "; a triangulation needs coordinates from 1e-100 to 1e100 "
                                                 "and an extent of at most 8e75; scale them");
  }

  Domain box(double half_side) const {
    std::vector<double> low, high;
    for (const double x : middle) {
      low.push_back(x - half_side * size);
      high.push_back(x + half_side * size);
    }
    return Domain::box(low, high);
  }
};

/// The seeds after rounding in the frame of the far box, so that both boxes see the same seeds. Its scale
/// makes numbers underflow that are some 280 orders of magnitude below the extent.
struct FarSeeds {
  std::vector<double> positions, weights;

  FarSeeds(const SeedsView& seeds, const Extent& extent)
      : positions(seeds.positions.begin(), seeds.positions.end()),
        weights(seeds.weights.begin(), seeds.weights.end()) {
    const Frame frame = Frame::of(extent.box(far_half_side).mesh(), false);
    for (double& x : positions) x = frame.to_device(x, 0) / frame.scale;
    for (double& w : weights) w = frame.weight_to_device(w) / frame.scale / frame.scale;
  }
};

/// Clips cells on the host in the far box: those that leave the near box, and from them outwards.
class OuterCells {
 public:
  OuterCells(const Device& device, const Extent& extent, const SeedSet& seeds, int threads)
      : threads_(threads),
        seeds_(seeds),
        tree_(build_packed_tree(seeds_, threads)),
        domain_(extent.box(far_half_side)),
        scene_(device.context(), domain_.mesh(), false, seeds_, tree_),
        host_(make_host_scene(scene_.scene)),
        known_(seeds_.size(), false) {}

  /// Appends the simplices of the outer cells as rows of seed indices.
  /// \param inside  per seed as given: its cell is known and does not leave the near box
  /// \param leaves  per seed as given: its cell leaves the near box
  void collect(const std::vector<bool>& inside, const std::vector<bool>& leaves,
               std::vector<std::uint32_t>& rows) {
    std::vector<std::uint32_t> front;
    for (std::uint32_t rank = 0; rank < seeds_.size(); ++rank) {
      known_[rank] = inside[seeds_.input[rank]];
      if (leaves[seeds_.input[rank]]) visit_once(rank, front);
    }
    while (!front.empty()) {
      std::vector<Piece> pieces(front.size());
      parallel_for(threads_, front.size(), [&](std::size_t begin, std::size_t end) {
        const std::unique_ptr<HostClipper> clipper = HostClipper::make(host_, true);
        std::array<double, 5> moments;
        for (std::size_t k = begin; k < end; ++k)
          pieces[k].status = clipper->clip(front[k], 0, moments, pieces[k].row);
      });
      std::vector<std::uint32_t> next;
      for (std::size_t k = 0; k < front.size(); ++k) {
        if (pieces[k].status == PIECE_EMPTY) continue;
        for (const std::int32_t border : pieces[k].row.border)
          if (border >= 0) visit_once(static_cast<std::uint32_t>(border), next);
        add_corners(front[k], pieces[k].row, rows);
      }
      front = std::move(next);
    }
  }

 private:
  struct Piece {
    int status;
    PieceBatch row;
  };

  void visit_once(std::uint32_t rank, std::vector<std::uint32_t>& front) {
    if (known_[rank]) return;
    known_[rank] = true;
    front.push_back(rank);
  }

  void add_row(std::uint32_t rank, std::initializer_list<std::int32_t> borders,
               std::vector<std::uint32_t>& rows) const {
    if (*std::min_element(borders.begin(), borders.end()) < 0) return;  // a corner on the box
    rows.push_back(seeds_.input[rank]);
    for (const std::int32_t border : borders)
      rows.push_back(seeds_.input[static_cast<std::uint32_t>(border)]);
  }

  void add_corners(std::uint32_t rank, const PieceBatch& batch, std::vector<std::uint32_t>& rows) const {
    const std::vector<std::int32_t>& border = batch.border;
    if (seeds_.dimension == 2) {
      for (std::size_t k = 0; k < border.size(); ++k)
        add_row(rank, {border[k == 0 ? border.size() - 1 : k - 1], border[k]}, rows);
      return;
    }
    for (std::size_t v = 0; v < batch.vertices(0); ++v)
      add_row(rank,
              {border[batch.link[6 * v + 3]], border[batch.link[6 * v + 4]], border[batch.link[6 * v + 5]]},
              rows);
  }

  int threads_;
  const SeedSet& seeds_;
  PackedTree tree_;
  Domain domain_;
  OwnScene scene_;
  HostScene host_;
  std::vector<bool> known_;
};

/// Per cell, whether it meets the boundary of the domain.
std::vector<bool> at_boundary(const Cells& cells) {
  std::vector<bool> at(cells.cell_count(), false);
  for (std::size_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
      for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f)
        if (cells.border[f].kind != Border::Kind::wall) at[i] = true;
  return at;
}

}  // namespace

Dual regular_triangulation(const Device& device, const SeedsView& seeds, const Options& options) {
  const FloatEnvironment environment;
  if (seeds.dimension != 2 && seeds.dimension != 3)
    throw Error(ErrorCode::invalid_argument,
                "a triangulation needs seeds of 2 or 3 coordinates, not " + std::to_string(seeds.dimension));
  const int threads = thread_count(options.threads);
  make_seed_set(seeds, seeds.dimension, threads);  // validates the seeds before their extent is computed
  Dual none;
  none.corners = seeds.dimension + 1;
  if (seeds.size() < static_cast<std::size_t>(none.corners)) return none;
  const Extent extent(seeds);
  if (!(extent.size > 0)) return none;
  extent.check();
  const FarSeeds far(seeds, extent);
  const SeedsView rounded{seeds.dimension, far.positions, far.weights};
  Options exact = options;
  exact.decisions = Decisions::exact;
  Diagram diagram(device, extent.box(near_half_side), exact);
  diagram.set_seeds(rounded);
  diagram.compute(false, true);
  const std::vector<bool> leaves = at_boundary(diagram.cells());
  std::vector<bool> inside(seeds.size());
  for (std::size_t i = 0; i < inside.size(); ++i)
    inside[i] = diagram.measures().status[i] == SeedStatus::ok && !leaves[i];
  std::vector<std::uint32_t> rows;
  OuterCells(device, extent, diagram.state().input->seeds, threads).collect(inside, leaves, rows);
  return extend_dual(diagram.dual(), rows, rounded);
}

}  // namespace powercell
