#include "bench/restricted.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <thread>

#include "bench/convex_piece.hpp"

namespace powercell::bench {

Link make_link(const SeedsView& seeds, std::uint32_t i, std::uint32_t j) {
  const double* a = &seeds.positions[3 * static_cast<std::size_t>(i)];
  const double* b = &seeds.positions[3 * static_cast<std::size_t>(j)];
  Link link{difference<double>(b, a), 0, 0, j};
  const double q2 = dot(link.q, link.q);
  link.offset = 0.5 * (q2 + seeds.weights[i] - seeds.weights[j]);
  link.distance = link.offset / std::sqrt(q2);
  return link;
}

namespace {

/// The state of one thread, which floods one region after the other.
template <class Piece>
class Flood {
 public:
  Flood(const test::Mesh& mesh, std::size_t corners, const SeedsView& seeds, const Links& links,
        std::uint32_t first)
      : mesh_(mesh),
        corners_(corners),
        seeds_(seeds),
        links_(links),
        measures(seeds.size(), 0.0),
        seen_in_(seeds.size(), ~std::uint32_t{0}),
        near_(first) {}

  void region(std::uint32_t r) {
    Vec3 corner[4], middle{};
    for (std::size_t k = 0; k < corners_; ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        corner[k][c] = mesh_.vertices[3 * mesh_.elements[corners_ * r + k] + c];
        middle[c] += corner[k][c] / static_cast<double>(corners_);
      }
    near_ = owner_of(middle, near_);
    waiting_.assign(1, near_);
    seen_in_[near_] = r;
    while (!waiting_.empty()) {
      const std::uint32_t i = waiting_.back();
      waiting_.pop_back();
      clip(i, corner, r);
    }
  }

 private:
  Vec3 relative(const Vec3& x, std::uint32_t i) const {
    return difference<double>(x.data(), &seeds_.positions[3 * static_cast<std::size_t>(i)]);
  }

  /// Moves from seed i to the neighbour whose power distance to x is least until no neighbour's is less: x
  /// lies in that seed's cell.
  std::uint32_t owner_of(const Vec3& x, std::uint32_t i) const {
    for (;;) {
      const Vec3 y = relative(x, i);
      double most = 0;
      std::uint32_t best = i;
      for (const Link* link = links_.begin(i); link != links_.end(i); ++link) {
        const double excess = dot(link->q, y) - link->offset;
        if (excess > most) most = excess, best = link->neighbor;
      }
      if (best == i) return i;
      i = best;
    }
  }

  void clip(std::uint32_t i, const Vec3* corner, std::uint32_t r) {
    Vec3 local[4];
    for (std::size_t k = 0; k < corners_; ++k) local[k] = relative(corner[k], i);
    piece_.start(local);
    double square = piece_.largest_square();
    const Link* const first = links_.begin(i);
    for (const Link* link = first; link != links_.end(i); ++link) {
      // A bisector outside the ball around the seed that contains the piece cuts nothing, nor do farther
      // ones.
      if (link->distance > 0 && link->distance * link->distance >= square) break;
      const auto border = first_link + static_cast<std::uint32_t>(link - first);
      const Cut cut = piece_.cut(link->q, link->offset, border);
      if (cut == Cut::nothing_left) return;
      if (cut == Cut::smaller) square = piece_.largest_square();
    }
    measures[i] += piece_.measure();
    borders_.clear();
    piece_.borders(borders_);
    for (const std::uint32_t border : borders_) {
      if (border < first_link) continue;
      const std::uint32_t j = first[border - first_link].neighbor;
      if (seen_in_[j] == r) continue;
      seen_in_[j] = r;
      waiting_.push_back(j);
    }
  }

  const test::Mesh& mesh_;
  std::size_t corners_;
  const SeedsView& seeds_;
  const Links& links_;

 public:
  std::vector<double> measures;

 private:
  std::vector<std::uint32_t> seen_in_;  ///< per seed: the last region in which it was put on the waiting list
  std::uint32_t near_;                  ///< the seed where the next search starts
  std::vector<std::uint32_t> waiting_, borders_;
  Piece piece_;
};

template <class Piece>
std::vector<double> flood_all(const test::Mesh& mesh, std::size_t corners, const SeedsView& seeds,
                              const Links& links, unsigned threads) {
  std::uint32_t first = 0;
  while (links.begin(first) == links.end(first)) ++first;
  const std::size_t regions = mesh.elements.size() / corners;
  constexpr std::size_t share = 64;
  std::atomic<std::size_t> next = 0;
  std::vector<std::vector<double>> parts(threads);
  std::vector<std::exception_ptr> errors(threads);
  const auto work = [&](unsigned t) {
    try {
      Flood<Piece> flood(mesh, corners, seeds, links, first);
      for (std::size_t at = share * next++; at < regions; at = share * next++)
        for (std::size_t r = at; r < std::min(at + share, regions); ++r)
          flood.region(static_cast<std::uint32_t>(r));
      parts[t] = std::move(flood.measures);
    } catch (...) {
      errors[t] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned t = 1; t < threads; ++t) others.emplace_back(work, t);
    work(0);
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  for (unsigned t = 1; t < threads; ++t)
    for (std::size_t i = 0; i < parts[0].size(); ++i) parts[0][i] += parts[t][i];
  return std::move(parts[0]);
}

}  // namespace

std::vector<double> restricted_measures(const test::Mesh& mesh, int corners, const SeedsView& seeds,
                                        const Links& links, unsigned threads) {
  return corners == 3 ? flood_all<PolygonPiece>(mesh, 3, seeds, links, threads)
                      : flood_all<PolyhedronPiece>(mesh, 4, seeds, links, threads);
}

}  // namespace powercell::bench
