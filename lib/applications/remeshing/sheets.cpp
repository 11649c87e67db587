// Cells kept to the sheet of the surface that their seed is on.
//
// A cell may reach to another sheet: through a thin wall, or where the surface crosses or touches itself.
// There no further seeds would separate the sheets. The parts of cells that do not contain their seed are
// given to the cells around them instead, whatever other seeds are nearer in space.
#include <algorithm>
#include <iterator>

#include "lib/applications/remeshing/cell_parts.hpp"
#include "lib/applications/remeshing/sampling.hpp"
#include "lib/base/disjoint_sets.hpp"

namespace powercell::remeshing {
namespace {

/// Connected triangles with parts of cells that do not contain their seed, and the seeds of the other parts
/// there.
struct Patch {
  std::vector<std::uint32_t> triangles, seeds;  // seeds ascending
};

/// The triangles at the place of a seed: several on a curve and around a corner.
std::vector<std::uint32_t> triangles_at(const Surface& surface, const Hold& hold) {
  std::vector<std::uint32_t> found{hold.place.triangle};
  const auto& row = surface.triangle[hold.place.triangle];
  if (hold.kind == Hold::Kind::curve) {
    const std::array<double, 3> share =
        barycentric(hold.place.at, surface.vertex[row[0]], surface.vertex[row[1]], surface.vertex[row[2]]);
    const auto opposite =
        static_cast<std::size_t>(std::min_element(share.begin(), share.end()) - share.begin());
    const std::uint32_t behind = surface.across[hold.place.triangle][(opposite + 1) % 3];
    if (behind != nothing) found.push_back(behind);
  }
  if (hold.kind != Hold::Kind::corner) return found;
  const auto at = std::find_if(row.begin(), row.end(),
                               [&](std::uint32_t v) { return surface.vertex[v] == hold.place.at; });
  for (std::size_t k = 0; at != row.end() && k < found.size(); ++k)
    for (std::size_t e = 0; e < 3; ++e) {
      const auto& here = surface.triangle[found[k]];
      const std::uint32_t next = surface.across[found[k]][e];
      if (next == nothing || (here[e] != *at && here[(e + 1) % 3] != *at)) continue;
      if (std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
    }
  return found;
}

template <class T>
bool contains(const std::vector<T>& list, const T& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

class Patches {
 public:
  explicit Patches(const Sampling& sampling)
      : diagram_(sampling.diagram()), stray_(diagram_.surface().size(), 0) {
    const CellParts parts = cell_parts(diagram_);
    const Surface& surface = diagram_.surface();
    std::vector<std::vector<std::uint32_t>> home(diagram_.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> placed;
    for (std::uint32_t i = 0; i < diagram_.size(); ++i) {
      if (!diagram_.seed(i).alive) continue;
      home[i] = triangles_at(surface, sampling.hold(i));
      for (const std::uint32_t t : home[i]) placed.emplace_back(t, i);
    }
    std::sort(placed.begin(), placed.end());
    bar_coincident(home);
    std::vector<bool> own(parts.seed.size(), false);  // per part: it contains its seed
    for (std::uint32_t i = 0; i < diagram_.size(); ++i)
      for (const std::uint32_t p : diagram_.pieces(i))
        if (contains(home[i], diagram_.piece(p).triangle)) own[parts.part[p]] = true;
    const auto is_stray = [&](std::uint32_t p) {
      const Piece& piece = diagram_.piece(p);
      return !own[parts.part[p]] ||
             std::binary_search(barred_.begin(), barred_.end(), std::pair{piece.seed, piece.triangle});
    };
    for (std::uint32_t t = 0; t < surface.size(); ++t)
      stray_[t] = std::any_of(diagram_.pieces_in(t).begin(), diagram_.pieces_in(t).end(), is_stray);
    DisjointSets sets(surface.size());
    for (std::uint32_t t = 0; t < surface.size(); ++t)
      for (const std::uint32_t next : surface.across[t])
        if (next != nothing && stray_[t] && stray_[next]) sets.unite(t, next);
    std::vector<std::uint32_t> number(surface.size(), nothing);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> strays;
    for (std::uint32_t t = 0; t < surface.size(); ++t) {
      if (!stray_[t]) continue;
      std::uint32_t& patch = number[sets.root(t)];
      if (patch == nothing) {
        patch = static_cast<std::uint32_t>(patch_.size());
        patch_.emplace_back();
      }
      patch_[patch].triangles.push_back(t);
      for (const std::uint32_t p : diagram_.pieces_in(t)) {
        const std::uint32_t seed = diagram_.piece(p).seed;
        if (own[parts.part[p]]) patch_[patch].seeds.push_back(seed);
        if (is_stray(p)) strays.emplace_back(seed, t);
      }
      for (auto at = std::lower_bound(placed.begin(), placed.end(), std::pair{t, 0u});
           at != placed.end() && at->first == t; ++at)
        patch_[patch].seeds.push_back(at->second);
    }
    barred_.insert(barred_.end(), strays.begin(), strays.end());
    for (Patch& patch : patch_) {
      std::sort(patch.seeds.begin(), patch.seeds.end());
      patch.seeds.erase(std::unique(patch.seeds.begin(), patch.seeds.end()), patch.seeds.end());
    }
  }

  const std::vector<Patch>& all() const { return patch_; }
  /// Seeds with a part that does not contain them, and a triangle of it.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& barred() const { return barred_; }

  /// For each triangle of a patch the seeds of the patch that can own a part of it.
  std::vector<Share> shares(const Patch& patch) const {
    SeedGrid grid;
    for (const std::uint32_t i : patch.seeds) {
      const Seed& seed = diagram_.seed(i);
      grid.insert(i, seed.at, seed.size, seed.weight);
    }
    std::vector<Share> shares;
    std::uint32_t near = patch.seeds.front();  // bounds the search
    for (const std::uint32_t t : patch.triangles) {
      if (diagram_.is_barred(near, t)) {
        const auto any = std::find_if(patch.seeds.begin(), patch.seeds.end(),
                                      [&](std::uint32_t i) { return !diagram_.is_barred(i, t); });
        if (any == patch.seeds.end()) continue;
        near = *any;
      }
      const Surface& surface = diagram_.surface();
      const Vec centre = (surface.corner(t, 0) + surface.corner(t, 1) + surface.corner(t, 2)) * (1.0 / 3);
      near = nearest(grid, t, centre, near);
      double most = 0, radius = 0;
      for (int k = 0; k < 3; ++k) {
        most = std::max(most, diagram_.power(near, surface.corner(t, k)));
        radius = std::max(radius, norm(surface.corner(t, k) - centre));
      }
      Share share{t, {}};
      grid.near(
          centre, [&](double w) { return radius + std::sqrt(std::max(most + w, 0.0)); },
          [&](std::uint32_t i) {
            if (!diagram_.is_barred(i, t)) share.seeds.push_back(i);
          });
      std::sort(share.seeds.begin(), share.seeds.end());
      drop_beaten(share);
      shares.push_back(std::move(share));
    }
    return shares;
  }

 private:
  /// Bars seeds from the triangles around others at the same place but on another sheet: neither is nearer.
  void bar_coincident(const std::vector<std::vector<std::uint32_t>>& home) {
    constexpr double near = 1e-6;  // in units of h
    SeedGrid grid;
    for (std::uint32_t i = 0; i < diagram_.size(); ++i)
      if (diagram_.seed(i).alive) grid.insert(i, diagram_.seed(i).at, diagram_.seed(i).size, 0);
    for (std::uint32_t i = 0; i < diagram_.size(); ++i) {
      if (!diagram_.seed(i).alive) continue;
      const double radius = near * diagram_.seed(i).size;
      grid.near(
          diagram_.seed(i).at, [&](double) { return radius; },
          [&](std::uint32_t j) {
            if (j == i || norm(diagram_.seed(j).at - diagram_.seed(i).at) > radius) return;
            const bool apart = std::none_of(home[i].begin(), home[i].end(),
                                            [&](std::uint32_t t) { return contains(home[j], t); });
            for (const std::uint32_t t : home[i])
              if (apart) barred_.emplace_back(j, t);
          });
    }
    std::sort(barred_.begin(), barred_.end());
  }

  /// The seed of a grid that is not barred from the triangle with the least power distance to x.
  std::uint32_t nearest(const SeedGrid& grid, std::uint32_t triangle, Vec x, std::uint32_t guess) const {
    std::uint32_t best = guess;
    const double most = diagram_.power(guess, x);
    grid.near(
        x, [&](double w) { return std::sqrt(std::max(most + w, 0.0)); },
        [&](std::uint32_t i) {
          if (diagram_.is_barred(i, triangle)) return;
          const double difference = diagram_.power(i, x) - diagram_.power(best, x);
          if (difference < 0 || (difference == 0 && i < best)) best = i;
        });
    return best;
  }

  /// Drops seeds to which one that is best at a corner is preferable at every corner, (11).
  void drop_beaten(Share& share) const {
    std::array<Vec, 3> corner;
    for (int k = 0; k < 3; ++k)
      corner[static_cast<std::size_t>(k)] = diagram_.surface().corner(share.triangle, k);
    std::array<std::uint32_t, 3> best{};
    for (std::size_t k = 0; k < 3; ++k)
      best[k] =
          *std::min_element(share.seeds.begin(), share.seeds.end(), [&](std::uint32_t i, std::uint32_t j) {
            return diagram_.power(i, corner[k]) < diagram_.power(j, corner[k]);
          });
    std::erase_if(share.seeds, [&](std::uint32_t j) {
      return std::any_of(best.begin(), best.end(), [&](std::uint32_t b) {
        return b != j && std::all_of(corner.begin(), corner.end(),
                                     [&](Vec x) { return diagram_.power(b, x) < diagram_.power(j, x); });
      });
    });
  }

  const LocalDiagram& diagram_;
  std::vector<char> stray_;  // per triangle
  std::vector<Patch> patch_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> barred_;
};

}  // namespace

std::size_t Sampling::keep_to_sheets() {
  const Patches patches(*this);
  for (const auto& [seed, triangle] : patches.barred()) diagram_.bar(seed, triangle);
  std::vector<Share> shares;
  for (const Patch& patch : patches.all()) {
    if (patch.seeds.empty()) continue;  // a component of the surface without seeds
    std::vector<Share> more = patches.shares(patch);
    std::move(more.begin(), more.end(), std::back_inserter(shares));
  }
  if (shares.empty()) return 0;
  diagram_.divide(shares);
  measure_changed();
  return shares.size();
}

}  // namespace powercell::remeshing
