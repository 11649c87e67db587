#include "lib/update/flips.hpp"

#include <algorithm>
#include <utility>

namespace powercell {

/// Two simplices that share a facet, and further ones with both of their other corners. The simplices that
/// replace them are the lower one with the upper corner in place of a shared one.
template <int D>
struct Flipper<D>::Flip {
  Facet lower, upper;  ///< the shared facet, from both sides
  std::array<bool, D + 1> has_third{};
  Corners third{};  ///< per shared corner of the lower simplex: the simplex with all others, if there is one
  std::size_t thirds = 0;
  /// Per replaced corner and corner of the new simplex, the facet outside that it meets there.
  std::array<std::array<Facet, D + 1>, D + 1> outer{};

  std::uint32_t lower_simplex() const { return lower / 4; }
  std::uint32_t upper_simplex() const { return upper / 4; }
  bool replaces(std::size_t m) const { return m != lower % 4 && !has_third[m]; }
};

/// \return false if the simplices are not all those of a flip
template <int D>
bool Flipper<D>::find_third_simplices(Flip& flip) const {
  const auto& lower = mesh_.simplex(flip.lower_simplex());
  const auto& upper = mesh_.simplex(flip.upper_simplex());
  for (std::size_t m = 0; m < mesh_.corners; ++m) {
    if (m == flip.lower % 4) continue;
    const Facet below = lower.across[m], above = upper.across[mesh_.index_of(upper.corner, lower.corner[m])];
    if (below == mesh_.outside || below / 4 != above / 4) continue;
    flip.has_third[m] = true;
    flip.third[m] = below / 4;
    ++flip.thirds;
  }
  if (flip.thirds >= D) return false;
  for (std::size_t a = 0; a < mesh_.corners; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (!flip.has_third[a] || !flip.has_third[b]) continue;
      // Both lie about the corner that is left, next to each other.
      const auto& third = mesh_.simplex(flip.third[a]);
      if (flip.third[a] == flip.third[b] ||
          third.across[mesh_.index_of(third.corner, lower.corner[b])] / 4 != flip.third[b])
        return false;
    }
  return true;
}

/// \return false if a new simplex would meet one with the same corners
template <int D>
bool Flipper<D>::find_outer_facets(Flip& flip) const {
  const auto& lower = mesh_.simplex(flip.lower_simplex());
  const auto& upper = mesh_.simplex(flip.upper_simplex());
  for (std::size_t m = 0; m < mesh_.corners; ++m) {
    if (!flip.replaces(m)) continue;
    Corners corner = lower.corner;
    corner[m] = upper.corner[flip.upper % 4];
    for (std::size_t j = 0; j < mesh_.corners; ++j) {
      Facet& outer = flip.outer[m][j];
      if (j == m) {
        outer = lower.across[m];
      } else if (j == flip.lower % 4) {
        outer = upper.across[mesh_.index_of(upper.corner, lower.corner[m])];
      } else if (flip.has_third[j]) {
        const auto& third = mesh_.simplex(flip.third[j]);
        outer = third.across[mesh_.index_of(third.corner, lower.corner[m])];
      } else {
        continue;
      }
      if (outer != mesh_.outside && mesh_.opposite(outer) == corner[j]) return false;
    }
  }
  return true;
}

/// Whether all new simplices are positive.
template <int D>
bool Flipper<D>::is_valid(const Flip& flip) const {
  Corners corner = mesh_.simplex(flip.lower_simplex()).corner;
  const std::uint32_t site = mesh_.opposite(flip.upper);
  for (std::size_t m = 0; m < mesh_.corners; ++m) {
    if (!flip.replaces(m)) continue;
    const std::uint32_t replaced = std::exchange(corner[m], site);
    if (mesh_.orientation_of(corner) <= 0) return false;
    corner[m] = replaced;
  }
  return true;
}

template <int D>
void Flipper<D>::apply(const Flip& flip) {
  const auto lower = mesh_.simplex(flip.lower_simplex()), upper = mesh_.simplex(flip.upper_simplex());
  const std::size_t top = flip.lower % 4;
  const std::uint32_t site = upper.corner[flip.upper % 4];
  mesh_.remove(flip.lower_simplex());
  mesh_.remove(flip.upper_simplex());
  forget(flip.lower_simplex());
  forget(flip.upper_simplex());
  for (std::size_t m = 0; m < mesh_.corners; ++m)
    if (flip.has_third[m]) {
      mesh_.remove(flip.third[m]);
      forget(flip.third[m]);
    }
  Corners made{};
  std::uint32_t left = site;
  for (std::size_t m = 0; m < mesh_.corners; ++m) {
    if (!flip.replaces(m)) continue;
    Corners corner = lower.corner;
    left = corner[m];
    corner[m] = site;
    made[m] = mesh_.add(corner);
    added_.push_back(made[m]);
  }
  for (std::size_t m = 0; m < mesh_.corners; ++m) {
    if (!flip.replaces(m)) continue;
    for (std::size_t j = 0; j < mesh_.corners; ++j) {
      if (j == m || j == top || flip.has_third[j])
        mesh_.link(mesh_.facet(made[m], j), flip.outer[m][j]);
      else
        mesh_.link(mesh_.facet(made[m], j), mesh_.facet(made[j], m));
    }
    add_facets_of(made[m]);
  }
  if (flip.thirds == D - 1) mesh_.hide(left, site);
  ++flips_;
}

template <int D>
bool Flipper<D>::flip(Facet f) {
  if (mesh_.across(f) == mesh_.outside) return false;
  Flip flip{f, mesh_.across(f)};
  if (!find_third_simplices(flip) || !find_outer_facets(flip) || !is_valid(flip)) return false;
  apply(flip);
  return true;
}

template <int D>
bool Flipper<D>::is_broken(Facet f) const {
  const Facet beyond = mesh_.across(f);
  if (beyond == mesh_.outside || is_inverted(f / 4) || is_inverted(beyond / 4)) return false;
  const int sign = mesh_.conflict(f / 4, mesh_.opposite(beyond));
  if (sign == 0) throw MeshUnusable();
  return sign > 0;
}

template <int D>
bool Flipper<D>::flip_open_facets() {
  const std::size_t before = flips_, most = 4 * mesh_.simplex_count() + 1000;
  while (!open_.empty()) {
    const Facet f = open_.back();
    open_.pop_back();
    if (mesh_.is_removed(f / 4) || !is_broken(f)) continue;
    if (!flip(f)) stuck_.push_back(f);
    if (flips_ > most) throw MeshUnusable();
  }
  return flips_ > before;
}

template <int D>
bool Flipper<D>::flip_inverted() {
  const std::size_t before = flips_;
  std::erase_if(inverted_list_, [&](std::uint32_t s) {
    for (std::size_t k = 0; k < mesh_.corners && is_inverted(s); ++k) flip(mesh_.facet(s, k));
    return !is_inverted(s);
  });
  return flips_ > before;
}

template <int D>
void Flipper<D>::run() {
  for (bool more = true; more;) {
    const bool some_inverted = flip_inverted();
    const bool some_open = flip_open_facets();
    more = some_inverted || (some_open && !(stuck_.empty() && inverted_list_.empty()));
    if (more) {  // a flip nearby may have made way
      open_.insert(open_.end(), stuck_.begin(), stuck_.end());
      stuck_.clear();
    }
  }
}

template <int D>
std::vector<std::uint32_t> Flipper<D>::take_stuck_sites() {
  std::vector<std::uint32_t> sites;
  for (const std::uint32_t s : inverted_list_)
    if (is_inverted(s))
      sites.insert(sites.end(), mesh_.simplex(s).corner.begin(), mesh_.simplex(s).corner.end());
  for (const Facet f : stuck_) {
    if (mesh_.is_removed(f / 4) || !is_broken(f)) continue;
    for (std::size_t k = 0; k < mesh_.corners; ++k)
      if (k != f % 4) sites.push_back(mesh_.simplex(f / 4).corner[k]);
  }
  std::erase_if(sites, [&](std::uint32_t site) { return mesh_.is_frame(site); });
  inverted_list_.clear();
  stuck_.clear();
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

template class Flipper<2>;
template class Flipper<3>;

}  // namespace powercell
