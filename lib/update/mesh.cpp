#include "lib/update/mesh.hpp"

#include <algorithm>
#include <utility>

namespace powercell {

template <int D>
std::array<const Site*, DualMesh<D>::corners> DualMesh<D>::places(std::uint32_t s) const {
  std::array<const Site*, corners> place;
  for (std::size_t k = 0; k < corners; ++k)
    place[k] = simplex_[s].corner[k] == infinite ? nullptr : &sites_[simplex_[s].corner[k]];
  return place;
}

template <int D>
int DualMesh<D>::orientation_of(const Corners& corner) const {
  std::array<const Site*, corners> place;
  for (std::size_t k = 0; k < corners; ++k) place[k] = &sites_[corner[k]];
  return orientation(place);
}

template <int D>
int DualMesh<D>::conflict(std::uint32_t s, std::uint32_t site) const {
  std::array<const Site*, corners> place = places(s);
  const std::size_t k = infinite_corner(s);
  if (k == corners) return conflict_sign(place, sites_[site]);
  place[k] = &sites_[site];
  return orientation(place);
}

template <int D>
std::uint32_t DualMesh<D>::add(const Corners& corner) {
  std::uint32_t s;
  if (free_.empty()) {
    s = static_cast<std::uint32_t>(simplex_.size());
    if (s >= none / 4) throw MeshUnusable();  // facets would not have numbers
    simplex_.emplace_back();
    mark_.push_back(0);
  } else {
    s = free_.back();
    free_.pop_back();
  }
  simplex_[s].corner = corner;
  for (const std::uint32_t site : corner) set_simplex_at(site, s);
  return s;
}

template <int D>
void DualMesh<D>::remove(std::uint32_t s) {
  simplex_[s].corner.fill(none);
  mark_[s] = 0;
  free_.push_back(s);
}

template <int D>
void DualMesh<D>::hide(std::uint32_t site, std::uint32_t near) {
  at_[site] = none;
  near_[site] = near;
  hidden_.push_back(site);
}

template <int D>
std::uint32_t DualMesh<D>::near_hidden(std::uint32_t site) const {
  std::uint32_t near = near_[site];
  for (std::size_t steps = 0; at_[near] == none; ++steps) {
    if (steps > sites_.size()) throw MeshUnusable();
    near = near_[near];
  }
  return near;
}

template <int D>
std::vector<std::uint32_t> DualMesh<D>::spanning_sites() const {
  std::vector<std::uint32_t> chosen;
  const auto count = static_cast<std::uint32_t>(sites_.size());
  if (count < corners) throw MeshUnusable();
  // All but the last corner: the first sites; the last ones are tried until they span the space.
  for (std::uint32_t a = 0; a < D; ++a) chosen.push_back(a);
  chosen.push_back(0);
  for (std::uint32_t last = D; last < count; ++last) {
    chosen.back() = last;
    Corners corner;
    std::copy(chosen.begin(), chosen.end(), corner.begin());
    const int sign = orientation_of(corner);
    if (sign == 0) continue;
    if (sign < 0) std::swap(chosen[0], chosen[1]);
    return chosen;
  }
  throw MeshUnusable();
}

template <int D>
void DualMesh<D>::build_first() {
  const std::vector<std::uint32_t> chosen = spanning_sites();
  Corners corner;
  std::copy(chosen.begin(), chosen.end(), corner.begin());
  const std::uint32_t inner = add(corner);
  std::array<std::uint32_t, corners> outer;
  for (std::size_t k = 0; k < corners; ++k) {
    // Beyond the facet a point has the other orientation, so two other corners change their places.
    Corners beyond = corner;
    beyond[k] = infinite;
    std::swap(beyond[(k + 1) % corners], beyond[(k + 2) % corners]);
    outer[k] = add(beyond);
    link(facet(inner, k), facet(outer[k], k));
  }
  for (std::size_t k = 0; k < corners; ++k)
    for (std::size_t j = 0; j < k; ++j)
      link(facet(outer[k], index_of(simplex_[outer[k]].corner, corner[j])),
           facet(outer[j], index_of(simplex_[outer[j]].corner, corner[k])));
  for (const std::uint32_t site : chosen) at_[site] = inner;
}

template <int D>
void DualMesh<D>::build(std::vector<Site> sites) {
  sites_ = std::move(sites);
  const auto count = static_cast<std::uint32_t>(sites_.size());
  simplex_.clear();
  simplex_.reserve((D == 2 ? 2 : 7) * std::size_t{count} + 64);
  free_.clear();
  mark_.clear();
  mark_.reserve(simplex_.capacity());
  hidden_.clear();
  at_.assign(count, none);
  near_.assign(count, 0);
  build_first();
  // Sites are in Hilbert order. First every 4,096th site, then every 512th between them, and so on, each near
  // the last one: so simplices do not grow long across space that is still empty.
  std::uint32_t last = simplex_[0].corner[0];
  for (std::uint32_t stride = 4096; stride > 0; stride /= 8)
    for (std::uint32_t site = 0; site < count; site += stride) {
      if (at_[site] != none || (stride < 4096 && site % (8 * stride) == 0)) continue;
      if (insert(site, last)) last = site;
      else hide(site, last);
      if (at_[last] == none) last = near_hidden(last);
    }
}

template <int D>
std::uint32_t DualMesh<D>::locate(std::uint32_t site, std::uint32_t start) const {
  std::uint32_t s = start;
  if (const std::size_t k = infinite_corner(s); k < corners) s = simplex_[s].across[k] / 4;
  std::size_t from = corners;  // the facet through which the walk came
  for (std::size_t steps = 0; steps <= simplex_.size() + 8; ++steps) {
    std::array<const Site*, corners> place = places(s);
    std::size_t leave = corners;
    for (std::size_t k = 0; k < corners && leave == corners; ++k) {
      if (k == from) continue;
      const Site* const replaced = std::exchange(place[k], &sites_[site]);
      if (orientation(place) < 0) leave = k;
      place[k] = replaced;
    }
    if (leave == corners) return s;
    const Facet next = simplex_[s].across[leave];
    s = next / 4;
    from = next % 4;
    if (is_infinite(s)) return s;
  }
  throw MeshUnusable();
}

template <int D>
void DualMesh<D>::find_cavity(std::uint32_t site, std::uint32_t start) {
  epoch_ += 2;
  if (epoch_ >= none - 2) {
    std::fill(mark_.begin(), mark_.end(), 0U);
    epoch_ = 2;
  }
  cavity_.assign(1, start);
  border_.clear();
  mark_[start] = epoch_;
  for (std::size_t k = 0; k < cavity_.size(); ++k) {
    const std::uint32_t s = cavity_[k];
    for (std::size_t c = 0; c < corners; ++c) {
      const std::uint32_t next = simplex_[s].across[c] / 4;
      if (mark_[next] == epoch_) continue;
      if (mark_[next] != epoch_ + 1) {
        const int sign = conflict(next, site);
        if (sign == 0) throw MeshUnusable();
        mark_[next] = sign > 0 ? epoch_ : epoch_ + 1;
        if (sign > 0) {
          cavity_.push_back(next);
          continue;
        }
      }
      border_.push_back(facet(s, c));
    }
  }
}

/// The new simplices at the facets of the cavity are those of the cavity there with the site in place of the
/// corner opposite. Two of them meet where their facets share a ridge, which the simplices of the cavity lie
/// about.
template <int D>
void DualMesh<D>::fill_cavity(std::uint32_t site) {
  for (const Facet f : border_) {
    Corners corner = simplex_[f / 4].corner;
    corner[f % 4] = site;
    const std::uint32_t made = add(corner);
    link(facet(made, f % 4), across(f));
    simplex_[f / 4].across[f % 4] = facet(made, f % 4);
  }
  for (const Facet f : border_) {
    const std::uint32_t made = across(f) / 4;
    for (std::size_t c = 0; c < corners; ++c) {
      if (c == f % 4) continue;
      std::uint32_t s = f / 4;
      std::size_t enter = f % 4, leave = c;  // the corners of s that are not in the ridge
      while (in_cavity(simplex_[s].across[leave] / 4)) {
        const std::uint32_t pivot = simplex_[s].corner[enter];
        const Facet next = simplex_[s].across[leave];
        s = next / 4;
        enter = next % 4;
        leave = index_of(simplex_[s].corner, pivot);
      }
      simplex_[made].across[c] = facet(simplex_[s].across[leave] / 4, enter);
    }
  }
  for (const std::uint32_t s : cavity_)
    for (const std::uint32_t corner : simplex_[s].corner)
      if (corner != infinite && at_[corner] != none && in_cavity(at_[corner])) hide(corner, site);
  for (const std::uint32_t s : cavity_) remove(s);
}

template <int D>
bool DualMesh<D>::insert(std::uint32_t site, std::uint32_t near) {
  const std::uint32_t start = locate(site, at_[near]);
  const int sign = conflict(start, site);
  if (sign == 0) throw MeshUnusable();
  if (sign < 0) return false;
  find_cavity(site, start);
  fill_cavity(site);
  return true;
}

template class DualMesh<2>;
template class DualMesh<3>;

}  // namespace powercell
