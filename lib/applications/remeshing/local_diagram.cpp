#include "lib/applications/remeshing/local_diagram.hpp"

#include <algorithm>
#include <limits>

namespace powercell::remeshing {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

double root(double square) {
  return square > 0 ? std::sqrt(square) : 0;
}

}  // namespace

Ring LocalDiagram::ring_of(std::uint32_t triangle) const {
  Ring ring;
  for (int k = 0; k < 3; ++k) ring.push_back({surface_.corner(triangle, k), ~k});
  return ring;
}

/// Clips the ring by the bisector of seeds i and j, (3), keeping the side of i.
/// \return false if nothing is left
bool LocalDiagram::cut(Ring& ring, std::uint32_t i, std::uint32_t j) {
  const Seed& own = seeds_[i];
  const Vec q = seeds_[j].at - own.at;
  const double offset = norm2(q) + own.weight - seeds_[j].weight;
  side_.resize(ring.size());
  bool inside = false, outside = false;
  for (std::size_t v = 0; v < ring.size(); ++v) {
    side_[v] = 2 * dot(q, ring[v].at - own.at) - offset;
    (side_[v] > 0 ? outside : inside) = true;
    // A corner on the bisector counts as inside it, so that the piece keeps an edge along the bisector.
    if (side_[v] == 0) side_[v] = -std::numeric_limits<double>::denorm_min();
  }
  if (!outside) return true;
  if (!inside) return false;
  // Interpolated from the kept end, so that the pieces on both sides of an edge of the surface get the same
  // point.
  const auto meet = [&](std::size_t kept, std::size_t lost, std::int32_t, std::int32_t) {
    const double share = side_[kept] / (side_[kept] - side_[lost]);
    return scratch_[kept].at + (scratch_[lost].at - scratch_[kept].at) * share;
  };
  cut_ring(ring, side_, static_cast<std::int32_t>(j), meet, scratch_);
  return ring.size() >= 3;
}

void LocalDiagram::add_piece(std::uint32_t seed, std::uint32_t triangle, const Ring& ring) {
  std::uint32_t id = static_cast<std::uint32_t>(pieces_.size());
  if (free_pieces_.empty()) {
    pieces_.emplace_back();
  } else {
    id = free_pieces_.back();
    free_pieces_.pop_back();
  }
  Piece& piece = pieces_[id];
  piece.seed = seed;
  piece.triangle = triangle;
  piece.rank = static_cast<std::uint32_t>(cells_[seed].pieces.size());
  piece.ring.assign(ring.begin(), ring.end());
  owners_[triangle].push_back(id);
  cells_[seed].pieces.push_back(id);
  mark_changed(seed);
}

void LocalDiagram::drop_piece(std::uint32_t piece) {
  // A triangle has few pieces, while a seed may have as many as the surface has triangles.
  std::vector<std::uint32_t>& owners = owners_[pieces_[piece].triangle];
  *std::find(owners.begin(), owners.end(), piece) = owners.back();
  owners.pop_back();
  std::vector<std::uint32_t>& own = cells_[pieces_[piece].seed].pieces;
  own[pieces_[piece].rank] = own.back();
  pieces_[own.back()].rank = pieces_[piece].rank;
  own.pop_back();
  mark_changed(pieces_[piece].seed);
  free_pieces_.push_back(piece);
}

void LocalDiagram::mark_changed(std::uint32_t seed) {
  if (is_changed_[seed]) return;
  is_changed_[seed] = 1;
  changed_.push_back(seed);
}

/// Updates the reach of the changed cells.
void LocalDiagram::finish() {
  for (const std::uint32_t i : changed_) {
    is_changed_[i] = 0;
    Cell& cell = cells_[i];
    cell.reach = -unbounded;
    for (const std::uint32_t p : cell.pieces)
      for (const Corner& corner : pieces_[p].ring) cell.reach = std::max(cell.reach, power(i, corner.at));
    most_reach_ = std::max(most_reach_, cell.reach);
  }
  // The bound only grows, so it is recomputed from time to time.
  if (++since_measured_ < std::max<std::size_t>(alive() / 4, 1)) return;
  since_measured_ = 0;
  most_reach_ = -unbounded;
  for (const Cell& cell : cells_) most_reach_ = std::max(most_reach_, cell.reach);
}

std::uint32_t LocalDiagram::find(std::uint32_t triangle, std::uint32_t seed) const {
  for (const std::uint32_t p : owners_[triangle])
    if (pieces_[p].seed == seed) return p;
  return nothing;
}

std::vector<std::uint32_t> LocalDiagram::neighbors(std::uint32_t i) const {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t p : cells_[i].pieces)
    for (const Corner& corner : pieces_[p].ring)
      if (corner.edge >= 0) result.push_back(static_cast<std::uint32_t>(corner.edge));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::uint32_t LocalDiagram::insert(Vec at, double weight, double size) {
  changed_.clear();
  std::uint32_t id = static_cast<std::uint32_t>(seeds_.size());
  if (free_seeds_.empty()) {
    seeds_.emplace_back();
    cells_.emplace_back();
    is_changed_.push_back(0);
  } else {
    id = free_seeds_.back();
    free_seeds_.pop_back();
  }
  const bool first = alive() == 1;
  seeds_[id] = {at, weight, size, true};
  mark_changed(id);
  if (first) {
    for (std::uint32_t t = 0; t < surface_.size(); ++t) add_piece(id, t, ring_of(t));
  } else {
    std::vector<std::uint32_t> affected;
    // A point that cell i loses to the new seed is within sqrt(reach_i + w_i) of seed i and within
    // sqrt(reach_i + w) of the new seed.
    grid_.near(
        at, [&](double w) { return root(most_reach_ + w) + root(most_reach_ + weight); },
        [&](std::uint32_t i) {
          const double reach = cells_[i].reach;
          if (!(reach + weight > 0)) return;
          const double most = root(reach + seeds_[i].weight) + root(reach + weight);
          if (norm2(at - seeds_[i].at) > most * most) return;
          for (const std::uint32_t p : cells_[i].pieces)
            for (const Corner& corner : pieces_[p].ring)
              if (norm2(corner.at - at) - weight < power(i, corner.at)) {
                affected.push_back(p);
                break;
              }
        });
    take_from(id, affected);
  }
  grid_.insert(id, at, size, weight);
  finish();
  return id;
}

/// Clips the affected pieces by the new seed and gives it the parts that they lose.
void LocalDiagram::take_from(std::uint32_t seed, std::vector<std::uint32_t>& affected) {
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t p : affected) triangles.push_back(pieces_[p].triangle);
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  std::vector<std::pair<std::uint32_t, Ring>> gained;
  for (const std::uint32_t t : triangles) {
    Ring ring = ring_of(t);
    bool any = true;
    for (std::size_t k = 0; any && k < owners_[t].size(); ++k)
      any = cut(ring, seed, pieces_[owners_[t][k]].seed);
    if (any) gained.emplace_back(t, std::move(ring));
  }
  for (const std::uint32_t p : affected) {
    mark_changed(pieces_[p].seed);
    if (!cut(pieces_[p].ring, pieces_[p].seed, seed)) drop_piece(p);
  }
  for (const auto& [t, ring] : gained) add_piece(seed, t, ring);
}

void LocalDiagram::remove(std::uint32_t seed) {
  changed_.clear();
  mark_changed(seed);
  grid_.remove(seed, seeds_[seed].at, seeds_[seed].size);
  const std::vector<std::uint32_t> pieces = cells_[seed].pieces;
  if (!pieces.empty() && alive() > 1) {
    const std::vector<std::uint32_t> heirs = this->heirs(seed, pieces);
    for (const std::uint32_t p : pieces) share_out(seed, p, heirs);
  }
  for (const std::uint32_t p : std::vector<std::uint32_t>(cells_[seed].pieces)) drop_piece(p);
  seeds_[seed].alive = false;
  free_seeds_.push_back(seed);
  finish();
}

/// All seeds that can own a point of the cell of `seed` after its removal. The squared distance of such a
/// point to its new owner j is at most b + w_j, where b is the largest over the corners of the least power
/// distance to the neighbours.
std::vector<std::uint32_t> LocalDiagram::heirs(std::uint32_t seed,
                                               const std::vector<std::uint32_t>& pieces) const {
  const std::vector<std::uint32_t> beside = neighbors(seed);
  std::vector<std::uint32_t> result = beside;  // included whatever the rounding of their distances
  Vec low{unbounded, unbounded, unbounded}, high{-unbounded, -unbounded, -unbounded};
  double bound = -unbounded;
  for (const std::uint32_t p : pieces)
    for (const Corner& corner : pieces_[p].ring) {
      double least = unbounded;
      for (const std::uint32_t j : beside) least = std::min(least, power(j, corner.at));
      bound = std::max(bound, least);
      const Vec x = corner.at;
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
  const Vec centre = (low + high) * 0.5;
  const double radius = norm(high - centre);
  grid_.near(
      centre, [&](double w) { return radius + root(bound + w); },
      [&](std::uint32_t j) {
        const double most = bound + seeds_[j].weight;
        if (most < 0) return;
        const double distance = radius + std::sqrt(most);
        if (norm2(seeds_[j].at - centre) <= distance * distance) result.push_back(j);
      });
  std::sort(result.begin(), result.end());  // for a deterministic order
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// The heirs that get a part of a freed piece.
std::vector<std::uint32_t> LocalDiagram::gainers(const Ring& freed, const std::vector<std::uint32_t>& heirs) {
  std::vector<std::uint32_t> best;  // heirs that own a corner
  for (const Corner& corner : freed) {
    const std::uint32_t nearest =
        *std::ranges::min_element(heirs, {}, [&](std::uint32_t j) { return power(j, corner.at); });
    if (std::ranges::find(best, nearest) == best.end()) best.push_back(nearest);
  }
  // An heir to which one of these is preferable at every corner gets nothing, (11).
  std::vector<std::uint32_t> left;
  for (const std::uint32_t j : heirs) {
    const bool beaten = std::ranges::any_of(best, [&](std::uint32_t k) {
      return k != j && std::ranges::all_of(freed, [&](const Corner& corner) {
               return power(k, corner.at) < power(j, corner.at);
             });
    });
    if (!beaten) left.push_back(j);
  }
  std::vector<std::uint32_t> result;
  for (const std::uint32_t j : left) {
    Ring ring = freed;
    if (cut_by_others(ring, j, left)) result.push_back(j);
  }
  return result;
}

/// Clips the ring by all of `seeds` but j.
/// \return false if nothing is left
bool LocalDiagram::cut_by_others(Ring& ring, std::uint32_t j, const std::vector<std::uint32_t>& seeds) {
  return std::ranges::all_of(seeds, [&](std::uint32_t k) { return k == j || cut(ring, j, k); });
}

/// Divides a piece of the removed seed among the heirs.
void LocalDiagram::share_out(std::uint32_t seed, std::uint32_t piece,
                             const std::vector<std::uint32_t>& heirs) {
  const std::uint32_t t = pieces_[piece].triangle;
  const std::vector<std::uint32_t> gaining = gainers(Ring(pieces_[piece].ring), heirs);
  // Pieces adjacent to the freed one grow; the other heirs get new pieces.
  std::vector<std::uint32_t> owners, again = gaining;
  for (const std::uint32_t p : owners_[t]) {
    const std::uint32_t j = pieces_[p].seed;
    if (j == seed) continue;
    owners.push_back(j);
    const bool beside = std::ranges::any_of(
        pieces_[p].ring, [&](const Corner& c) { return c.edge == static_cast<std::int32_t>(seed); });
    if (beside && std::ranges::find(again, j) == again.end()) again.push_back(j);
  }
  for (const std::uint32_t j : gaining)
    if (std::ranges::find(owners, j) == owners.end()) owners.push_back(j);
  for (const std::uint32_t j : again) {
    Ring ring = ring_of(t);
    const bool any = cut_by_others(ring, j, owners);
    const std::uint32_t old = find(t, j);
    if (old != nothing && any) {
      pieces_[old].ring = ring;
      mark_changed(j);
    } else if (old != nothing) {
      drop_piece(old);
    } else if (any) {
      add_piece(j, t, ring);
    }
  }
}

}  // namespace powercell::remeshing
