#include "lib/update/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace powercell {

template <int D>
std::array<const Site*, DualMesh<D>::corners> DualMesh<D>::places(std::uint32_t s) const {
  std::array<const Site*, corners> place;
  for (std::size_t k = 0; k < corners; ++k) place[k] = &sites_[simplex_[s].corner[k]];
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
  return conflict_sign(places(s), sites_[site]);
}

template <int D>
std::uint32_t DualMesh<D>::add(const Corners& corner) {
  std::uint32_t s;
  if (free_.empty()) {
    s = static_cast<std::uint32_t>(simplex_.size());
    if (s >= outside / 4) throw MeshUnusable();  // facets would not have numbers
    simplex_.emplace_back();
    mark_.push_back(0);
  } else {
    s = free_.back();
    free_.pop_back();
  }
  simplex_[s].corner = corner;
  for (const std::uint32_t site : corner) {
    at_[site] = s;
    changed_[site] = 1;
  }
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
void DualMesh<D>::build(std::vector<Site> sites, const std::array<Site, corners>& frame) {
  const auto count = static_cast<std::uint32_t>(sites.size());
  sites_ = std::move(sites);
  sites_.insert(sites_.end(), frame.begin(), frame.end());
  simplex_.clear();
  simplex_.reserve((D == 2 ? 2 : 7) * std::size_t{count} + 64);
  free_.clear();
  mark_.clear();
  mark_.reserve(simplex_.capacity());
  hidden_.clear();
  at_.assign(sites_.size(), none);
  near_.assign(sites_.size(), 0);
  changed_.assign(sites_.size(), 0);
  Corners first{};
  for (std::size_t k = 0; k < corners; ++k) first[k] = count + static_cast<std::uint32_t>(k);
  simplex_[add(first)].across.fill(outside);
  // Sites are in Hilbert order. First every 4,096th site, then every 512th between them, and so on, each near
  // the last one: so simplices do not grow long across space that is still empty.
  std::uint32_t last = count;
  for (std::uint32_t stride = 4096; stride > 0; stride /= 8)
    for (std::uint32_t site = 0; site < count; site += stride) {
      if (at_[site] != none || (stride < 4096 && site % (8 * stride) == 0)) continue;
      if (insert(site, last))
        last = site;
      else
        hide(site, last);
      if (at_[last] == none) last = near_hidden(last);
    }
}

template <int D>
void DualMesh<D>::sort_simplices() {
  std::vector<std::uint32_t> first(sites_.size() + 1), number(simplex_.size());
  const auto lowest = [&](std::uint32_t s) {
    return *std::min_element(simplex_[s].corner.begin(), simplex_[s].corner.end());
  };
  for (std::uint32_t s = 0; s < simplex_.size(); ++s)
    if (!is_removed(s)) ++first[lowest(s) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Simplex> sorted(first.back());
  for (std::uint32_t s = 0; s < simplex_.size(); ++s)
    if (!is_removed(s)) number[s] = first[lowest(s)]++;
  for (std::uint32_t s = 0; s < simplex_.size(); ++s) {
    if (is_removed(s)) continue;
    Simplex& simplex = sorted[number[s]];
    simplex = simplex_[s];
    for (Facet& f : simplex.across)
      if (f != outside) f = facet(number[f / 4], f % 4);
  }
  for (std::uint32_t& s : at_)
    if (s != none) s = number[s];
  simplex_ = std::move(sorted);
  mark_.assign(simplex_.size(), 0);
  free_.clear();
}

template <int D>
std::uint32_t DualMesh<D>::locate(std::uint32_t site, std::uint32_t start) const {
  std::uint32_t s = start;
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
    if (next == outside) break;
    s = next / 4;
    from = next % 4;
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
      if (in_cavity(simplex_[s].across[c])) continue;
      const std::uint32_t next = simplex_[s].across[c] / 4;
      if (simplex_[s].across[c] != outside && mark_[next] != epoch_ + 1) {
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
  made_.clear();
  for (const Facet f : border_) {
    Corners corner = simplex_[f / 4].corner;
    corner[f % 4] = site;
    const std::uint32_t made = add(corner);
    made_.push_back(made);
    link(facet(made, f % 4), across(f));
    simplex_[f / 4].across[f % 4] = facet(made, f % 4);
  }
  for (const Facet f : border_) {
    const std::uint32_t made = across(f) / 4;
    for (std::size_t c = 0; c < corners; ++c) {
      if (c == f % 4) continue;
      std::uint32_t s = f / 4;
      std::size_t enter = f % 4, leave = c;  // the corners of s that are not in the ridge
      while (in_cavity(simplex_[s].across[leave])) {
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
      if (at_[corner] != none && mark_[at_[corner]] == epoch_) hide(corner, site);
  for (const std::uint32_t s : cavity_) remove(s);
}

template <int D>
bool DualMesh<D>::insert(std::uint32_t site, std::uint32_t near, std::vector<std::uint32_t>* added) {
  const std::uint32_t start = locate(site, at_[near]);
  for (const std::uint32_t corner : simplex_[start].corner)
    if (std::equal(sites_[corner].begin(), sites_[corner].begin() + 3, sites_[site].begin()))
      throw MeshUnusable();
  const int sign = conflict(start, site);
  if (sign == 0) throw MeshUnusable();
  if (sign < 0) return false;
  find_cavity(site, start);
  fill_cavity(site);
  if (added) added->insert(added->end(), made_.begin(), made_.end());
  return true;
}

template <int D>
FarFrame<D> FarFrame<D>::around(std::span<const Site> sites, const std::array<double, 3>& low,
                                const std::array<double, 3>& high) {
  constexpr double most = 1e30, least = 1e-30;
  FarFrame frame{{}, low, high, 0};
  double lowest = sites.empty() ? 0 : sites.front()[3], highest = lowest;
  for (const Site& site : sites) {
    for (std::size_t k = 0; k < D; ++k) {
      frame.low[k] = std::min(frame.low[k], site[k]);
      frame.high[k] = std::max(frame.high[k], site[k]);
    }
    lowest = std::min(lowest, site[3]);
    highest = std::max(highest, site[3]);
  }
  double reach = std::sqrt(highest - lowest), largest = 0;
  for (std::size_t k = 0; k < D; ++k) {
    reach = std::max(reach, frame.high[k] - frame.low[k]);
    largest = std::max({largest, std::fabs(frame.low[k]), std::fabs(frame.high[k])});
  }
  if (!(largest + reach < most) || !(reach > least)) throw MeshUnusable();
  // Sites may move by their reach, and lose a thousand times its square in weight: from where they are, and
  // from the domain, the frame is at least 20 times the reach away in each direction. No place of it is
  // special, so that seeds in order do not tie with it.
  const double far = 200 * reach;
  constexpr double direction[4][3] = {
      {-1.02, -0.71, -0.53}, {1.09, -0.67, -0.61}, {0.07, 1.13, -0.57}, {0.03, 0.05, 1.21}};
  for (std::size_t p = 0; p <= D; ++p) {
    frame.points[p] = {0, 0, 0, lowest};
    for (std::size_t k = 0; k < D; ++k)
      frame.points[p][k] = (frame.low[k] + frame.high[k]) / 2 + far * direction[p][k];
  }
  for (std::size_t k = 0; k < D; ++k) {
    frame.low[k] -= reach;
    frame.high[k] += reach;
  }
  frame.least_weight = lowest - 1000 * reach * reach;
  return frame;
}

template <int D>
bool FarFrame<D>::holds(std::span<const Site> sites) const {
  return std::all_of(sites.begin(), sites.end(), [&](const Site& site) {
    for (std::size_t k = 0; k < D; ++k)
      if (!(site[k] >= low[k] && site[k] <= high[k])) return false;
    return site[3] >= least_weight;
  });
}

template struct FarFrame<2>;
template struct FarFrame<3>;
template class DualMesh<2>;
template class DualMesh<3>;

}  // namespace powercell
