#include "lib/collect/join_weld.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace powercell {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Corresponding corners are welded if they are closer than this times the domain's diagonal, a bound for
/// rounding in float, or than half the extent of the facet.
constexpr double float_rounding = 1e-5;

/// Facets without a partner are sealed within this times the median distance of welded corners.
constexpr double seal_ratio = 16;

}  // namespace

CellWeld::CellWeld(const Domain& domain, const Cells& cells)
    : cells_(cells),
      mesh_(domain.mesh()),
      surface_(domain.kind() == DomainKind::surface),
      diagonal_(0),
      rounding_(0) {
  const std::array<double, 3> low = domain.low(), high = domain.high();
  for (std::size_t k = 0; k < 3; ++k) {
    diagonal_ = std::hypot(diagonal_, high[k] - low[k]);
    rounding_ = std::max({rounding_, std::abs(low[k]), std::abs(high[k])});
  }
  rounding_ *= 4 * std::numeric_limits<double>::epsilon();
  if (domain.kind() != DomainKind::polygon) return;
  boundary_ends_.resize(mesh_.boundary_count);
  for (std::size_t r = 0; r < mesh_.region_count(); ++r) {
    const std::uint32_t begin = mesh_.region_offset[r], end = mesh_.region_offset[r + 1];
    for (std::uint32_t k = begin; k < end; ++k)
      if (mesh_.facet[k].kind == Border::Kind::boundary)
        boundary_ends_[mesh_.facet[k].index] = {mesh_.region_vertex[k],
                                                mesh_.region_vertex[k + 1 < end ? k + 1 : begin]};
  }
}

void CellWeld::unite(const Pairs& pairs) {
  for (const auto& [a, b] : pairs) welded_.unite(a, b);
}

double CellWeld::distance2(std::uint32_t a, std::uint32_t b) const {
  const double *x = position(a), *y = position(b);
  double sum = 0;
  for (int k = 0; k < cells_.dimension; ++k) sum += (x[k] - y[k]) * (x[k] - y[k]);
  return sum;
}

double CellWeld::extent2(std::uint32_t f) const {
  double most = 0;
  for (const std::uint32_t v : face(f)) most = std::max(most, distance2(face(f)[0], v));
  return most;
}

void CellWeld::gather(std::size_t cell) {
  const std::uint64_t begin = cells_.cell_offset[cell], end = cells_.cell_offset[cell + 1];
  first_vertex_ = cells_.vertex_offset[begin];
  first_face_ = cells_.face_offset[begin];
  welded_.reset(cells_.vertex_offset[end] - first_vertex_);
  on_interior_.assign(welded_.size(), 0);
  removed_.assign(cells_.face_offset[end] - first_face_, 0);
  corners_.clear();
  face_ = {0};
  piece_ = {0};
  facets_.clear();
  for (std::uint64_t p = begin; p < end; ++p) {
    const auto base = static_cast<std::uint32_t>(cells_.vertex_offset[p] - first_vertex_);
    const auto count = static_cast<std::uint32_t>(cells_.vertex_offset[p + 1] - cells_.vertex_offset[p]);
    for (std::uint64_t f = cells_.face_offset[p]; f < cells_.face_offset[p + 1]; ++f) {
      if (cells_.cell_dimension == 2) {
        const auto k = static_cast<std::uint32_t>(f - cells_.face_offset[p]);
        corners_.insert(corners_.end(), {base + k, base + (k + 1) % count});
      } else {
        for (std::uint64_t k = cells_.loop_offset[f]; k < cells_.loop_offset[f + 1]; ++k)
          corners_.push_back(base + cells_.loop[k]);
      }
      face_.push_back(corners_.size());
      const Border& border = cells_.border[f];
      if (border.kind == Border::Kind::interior)
        facets_.push_back({cells_.region[p], border.index, static_cast<std::uint32_t>(f - first_face_)});
    }
    piece_.push_back(face_.size() - 1);
  }
}

/// Pairs each corner of either facet with the nearest one of the other. Returns the largest squared distance.
double CellWeld::pair_nearest(std::uint32_t a, std::uint32_t b, Pairs& pairs) const {
  double most = 0;
  for (const auto& [from, to] : {std::pair{face(a), face(b)}, std::pair{face(b), face(a)}}) {
    for (const std::uint32_t v : from) {
      std::uint32_t nearest = to[0];
      for (const std::uint32_t w : to)
        if (distance2(v, w) < distance2(v, nearest)) nearest = w;
      pairs.emplace_back(v, nearest);
      most = std::max(most, distance2(v, nearest));
    }
  }
  return most;
}

/// Pairs the corners of facet a, in order, with those of facet b in the opposite (or the same) order, with
/// the rotation that brings them closest. If rounding has given one facet more edges, pairs by distance only.
/// \return the largest squared distance
double CellWeld::pair_corners(std::uint32_t a, std::uint32_t b, bool opposite, Pairs& pairs) const {
  pairs.clear();
  const std::span<const std::uint32_t> from = face(a), to = face(b);
  const double nearest = from.size() == 2 ? 0 : pair_nearest(a, b, pairs);
  if (from.size() != to.size()) return nearest;
  const std::size_t n = from.size();
  const auto partner = [&](std::size_t k, std::size_t turn) {
    return to[opposite ? (2 * n - 1 - k + turn) % n : (k + turn) % n];
  };
  double least = infinite;
  std::size_t best = 0;
  // The ends of an edge correspond by direction, so there is only one rotation.
  for (std::size_t turn = 0; turn < (n == 2 ? 1 : n); ++turn) {
    double most = 0;
    for (std::size_t k = 0; k < n && most < least; ++k)
      most = std::max(most, distance2(from[k], partner(k, turn)));
    if (most < least) {
      least = most;
      best = turn;
    }
  }
  if (n > 2 && least > 4 * nearest + rounding_ * rounding_) return nearest;
  pairs.clear();
  for (std::size_t k = 0; k < n; ++k) pairs.emplace_back(from[k], partner(k, best));
  return least;
}

/// Several triangles may share an edge of a surface, each with the next one behind it, in any orientation. So
/// the partner is the nearest edge of the triangle behind.
void CellWeld::match_surface_edge(std::uint32_t f, const Facet& facet) {
  Pairs pairs, best;
  double least = infinite;
  const auto begin = std::lower_bound(facets_.begin(), facets_.end(), facet.behind,
                                      [](const Facet& x, std::uint32_t region) { return x.region < region; });
  for (auto other = begin; other != facets_.end() && other->region == facet.behind; ++other) {
    for (const bool opposite : {true, false}) {
      const double apart = pair_corners(f, other->face, opposite, pairs);
      if (apart >= least) continue;
      least = apart;
      best = pairs;
    }
  }
  const double bound = float_rounding * diagonal_;
  if (least <= extent2(f) / 4 + bound * bound) unite(best);
}

void CellWeld::match_facets() {
  const auto by_name = [](const Facet& a, const Facet& b) {
    return std::tie(a.region, a.behind, a.face) < std::tie(b.region, b.behind, b.face);
  };
  std::sort(facets_.begin(), facets_.end(), by_name);
  mismatch2_.clear();
  Pairs pairs, best;
  const double bound = float_rounding * diagonal_;
  for (const Facet& facet : facets_) {
    if (surface_) {
      match_surface_edge(facet.face, facet);
      continue;
    }
    if (facet.region > facet.behind || removed_[facet.face]) continue;
    double least = infinite;
    std::uint32_t partner = 0;
    auto other =
        std::lower_bound(facets_.begin(), facets_.end(), Facet{facet.behind, facet.region, 0}, by_name);
    for (; other != facets_.end() && other->region == facet.behind && other->behind == facet.region;
         ++other) {
      if (removed_[other->face]) continue;
      const double apart = pair_corners(facet.face, other->face, true, pairs);
      if (apart >= least) continue;
      least = apart;
      partner = other->face;
      std::swap(best, pairs);
    }
    if (!(least <= std::max(extent2(facet.face), extent2(partner)) / 4 + bound * bound)) continue;
    unite(best);
    removed_[facet.face] = removed_[partner] = 1;
    mismatch2_.push_back(least);
  }
}

/// Closes facets without a partner, because the piece behind was too flat to be kept: shrinks small ones to a
/// point, and joins two that face each other across the missing piece. Larger ones stay.
void CellWeld::seal(const std::vector<Facet>& open) {
  double median = 0;
  if (!mismatch2_.empty()) {
    const auto middle = mismatch2_.begin() + static_cast<std::ptrdiff_t>(mismatch2_.size() / 2);
    std::nth_element(mismatch2_.begin(), middle, mismatch2_.end());
    median = std::sqrt(*middle);
  }
  const double within = seal_ratio * std::max(median, rounding_);
  std::vector<std::pair<double, std::uint32_t>> by_x;  // least coordinate, face
  for (const Facet& facet : open) {
    const std::span<const std::uint32_t> corners = face(facet.face);
    if (extent2(facet.face) <= within * within) {
      for (const std::uint32_t v : corners) welded_.unite(corners[0], v);
      removed_[facet.face] = 1;
      continue;
    }
    double x = infinite;
    for (const std::uint32_t v : corners) x = std::min(x, position(v)[0]);
    by_x.emplace_back(x, facet.face);
  }
  std::sort(by_x.begin(), by_x.end());
  Pairs pairs;
  for (std::size_t a = 0; a < by_x.size(); ++a) {
    for (std::size_t b = a + 1; b < by_x.size() && by_x[b].first <= by_x[a].first + within; ++b) {
      if (removed_[by_x[a].second] || removed_[by_x[b].second]) continue;
      if (pair_corners(by_x[a].second, by_x[b].second, true, pairs) > within * within) continue;
      unite(pairs);
      removed_[by_x[a].second] = removed_[by_x[b].second] = 1;
    }
  }
}

void CellWeld::unite_at_boundary_vertices() {
  struct Place {
    std::array<double, 2> vertex;  // of the domain, so equal exactly
    std::uint32_t corner;
  };
  std::vector<Place> places;
  const auto wall = [&](std::size_t f) { return border(f).kind == Border::Kind::wall; };
  for (std::size_t p = 0; p < piece_count(); ++p) {
    const std::size_t begin = piece(p), n = piece(p + 1) - begin;
    for (std::size_t k = 0; k < n; ++k) {
      if (border(begin + k).kind != Border::Kind::boundary) continue;
      // An edge of the boundary starts and ends in vertices of the domain, except where a wall cuts it.
      const std::array<std::uint32_t, 2> ends = boundary_ends_[border(begin + k).index];
      const bool open[2] = {wall(begin + (k + n - 1) % n), wall(begin + (k + 1) % n)};
      for (std::size_t e = 0; e < 2; ++e)
        if (!open[e])
          places.push_back(
              {{mesh_.vertices[2 * ends[e]], mesh_.vertices[2 * ends[e] + 1]}, face(begin + k)[e]});
    }
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.vertex < b.vertex; });
  for (std::size_t k = 1; k < places.size(); ++k)
    if (places[k].vertex == places[k - 1].vertex) welded_.unite(places[k].corner, places[k - 1].corner);
}

void CellWeld::unite_short_edges() {
  for (std::size_t f = 0; f < face_count(); ++f) {
    const std::span<const std::uint32_t> corners = face(f);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t a = corners[k], b = corners[(k + 1) % corners.size()];
      if (distance2(a, b) <= rounding_ * rounding_) welded_.unite(a, b);
    }
  }
}

void CellWeld::weld(std::size_t cell) {
  gather(cell);
  if (!facets_.empty()) match_facets();
  if (!surface_) {
    std::vector<Facet> open;
    for (const Facet& facet : facets_)
      if (!removed_[facet.face]) open.push_back(facet);
    if (!open.empty()) seal(open);
  }
  if (!boundary_ends_.empty() && piece_count() > 1) unite_at_boundary_vertices();
  unite_short_edges();
  same_.resize(welded_.size());
  for (std::uint32_t v = 0; v < same_.size(); ++v) same_[v] = welded_.root(v);
  for (const Facet& facet : facets_)
    for (const std::uint32_t v : face(facet.face)) on_interior_[same_[v]] = 1;
}

}  // namespace powercell
