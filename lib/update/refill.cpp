#include "lib/update/refill.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace powercell {
namespace {

template <int D>
using FacetKey = std::array<std::uint32_t, D>;

struct KeyHash {
  template <std::size_t n>
  std::size_t operator()(const std::array<std::uint32_t, n>& key) const {
    std::uint64_t h = 0;
    for (const std::uint32_t k : key) h = (h ^ k) * 0x9E3779B97F4A7C15U;
    return static_cast<std::size_t>(h ^ h >> 32);
  }
};

/// The corners of a facet, ascending, and whether the simplex lies on their positive side.
template <int D>
std::pair<FacetKey<D>, bool> key_of(const typename DualMesh<D>::Corners& corner, std::size_t opposite) {
  FacetKey<D> key;
  for (std::size_t k = 0, at = 0; k < corner.size(); ++k)
    if (k != opposite) key[at++] = corner[k];
  bool even = opposite % 2 == 0;
  for (std::size_t i = 1; i < D; ++i)
    for (std::size_t j = i; j > 0 && key[j] < key[j - 1]; --j) {
      std::swap(key[j], key[j - 1]);
      even = !even;
    }
  return {key, even};
}

/// The simplices at some sites, to be replaced.
template <int D>
class Hole {
 public:
  using Facet = typename DualMesh<D>::Facet;
  using Corners = typename DualMesh<D>::Corners;

  /// The hole about a site and all sites to be refilled that have a simplex with one of them.
  Hole(DualMesh<D>& mesh, std::uint32_t first, const std::unordered_set<std::uint32_t>& to_refill)
      : mesh_(mesh), inner_{first} {
    std::unordered_set<std::uint32_t> seen{first};
    for (std::size_t k = 0; k < inner_.size(); ++k) {
      add_star(inner_[k]);
      for (; scanned_ < simplices_.size(); ++scanned_)
        for (const std::uint32_t site : mesh_.simplex(simplices_[scanned_]).corner)
          if (to_refill.contains(site) && seen.insert(site).second) inner_.push_back(site);
    }
    for (const std::uint32_t s : simplices_)
      for (std::size_t k = 0; k < mesh_.corners; ++k)
        if (!in_hole_.contains(mesh_.simplex(s).across[k] / 4)) border_.push_back(mesh_.facet(s, k));
    for (const std::uint32_t s : simplices_)
      for (const std::uint32_t site : mesh_.simplex(s).corner)
        if (!mesh_.is_frame(site)) sites_.push_back(site);
    std::sort(sites_.begin(), sites_.end());
    sites_.erase(std::unique(sites_.begin(), sites_.end()), sites_.end());
  }

  const std::vector<std::uint32_t>& inner_sites() const { return inner_; }
  std::size_t site_count() const { return sites_.size(); }

  /// \return the sites that the hole must grow by; none if it is filled
  std::vector<std::uint32_t> fill(Flipper<D>& flipper);

 private:
  void add_star(std::uint32_t site) {
    std::vector<std::uint32_t> open;
    std::unordered_set<std::uint32_t> seen;
    const auto visit = [&](std::uint32_t s) {
      if (!seen.insert(s).second) return;
      open.push_back(s);
      if (in_hole_.insert(s).second) simplices_.push_back(s);
    };
    visit(mesh_.simplex_at(site));
    while (!open.empty()) {
      const auto simplex = mesh_.simplex(open.back());
      open.pop_back();
      for (std::size_t k = 0; k < mesh_.corners; ++k)
        if (simplex.corner[k] != site && simplex.across[k] != mesh_.outside) visit(simplex.across[k] / 4);
    }
  }

  /// A site of the local mesh in the whole; the frame is the same.
  std::uint32_t global(std::uint32_t site) const {
    return site < sites_.size() ? sites_[site]
                                : static_cast<std::uint32_t>(mesh_.site_count() + (site - sites_.size()));
  }
  Corners global(Corners corner) const {
    for (std::uint32_t& site : corner) site = global(site);
    return corner;
  }
  /// The sites of facets, without the frame.
  std::vector<std::uint32_t> sites_of(const std::vector<Facet>& facets) const {
    std::vector<std::uint32_t> found;
    for (const Facet f : facets)
      for (std::size_t k = 0; k < mesh_.corners; ++k)
        if (k != f % 4 && !mesh_.is_frame(mesh_.simplex(f / 4).corner[k]))
          found.push_back(mesh_.simplex(f / 4).corner[k]);
    return found;
  }
  std::vector<Facet> find_border();
  bool flood();
  void replace(Flipper<D>& flipper);

  DualMesh<D>& mesh_;
  std::vector<std::uint32_t> inner_, simplices_, sites_;
  std::size_t scanned_ = 0;
  std::unordered_set<std::uint32_t> in_hole_;
  std::vector<Facet> border_;  // of the mesh, from inside
  DualMesh<D> local_;
  std::vector<Facet> local_border_;      // per border_: the same facet of the local mesh, from inside
  std::vector<std::uint8_t> is_border_;  // per local facet, from either side
  std::vector<std::uint32_t> filling_;   // local simplices
  std::vector<std::uint32_t> made_;      // per local simplex: that of the mesh
};

/// \return the facets that the local mesh does not have
template <int D>
std::vector<typename DualMesh<D>::Facet> Hole<D>::find_border() {
  constexpr Facet missing = ~Facet{0};
  std::unordered_map<FacetKey<D>, std::pair<std::size_t, bool>, KeyHash> place;
  for (std::size_t b = 0; b < border_.size(); ++b) {
    const auto [key, positive] = key_of<D>(mesh_.simplex(border_[b] / 4).corner, border_[b] % 4);
    place[key] = {b, positive};
  }
  local_border_.assign(border_.size(), missing);
  is_border_.assign(4 * local_.simplex_count(), 0);
  for (std::uint32_t s = 0; s < local_.simplex_count(); ++s) {
    if (local_.is_removed(s)) continue;
    const Corners corner = global(local_.simplex(s).corner);
    for (std::size_t k = 0; k < mesh_.corners; ++k) {
      const auto [key, positive] = key_of<D>(corner, k);
      const auto found = place.find(key);
      if (found == place.end()) continue;
      is_border_[mesh_.facet(s, k)] = 1;
      if (positive == found->second.second) local_border_[found->second.first] = mesh_.facet(s, k);
    }
  }
  std::vector<Facet> not_found;
  for (std::size_t b = 0; b < border_.size(); ++b)
    if (local_border_[b] == missing) not_found.push_back(border_[b]);
  return not_found;
}

/// Finds the local simplices within the border. \return whether they fill the hole
template <int D>
bool Hole<D>::flood() {
  made_.assign(local_.simplex_count(), mesh_.none);
  std::vector<std::uint8_t> has_simplex(sites_.size());
  const auto visit = [&](std::uint32_t s) {
    if (made_[s] != mesh_.none) return;
    made_[s] = 0;
    filling_.push_back(s);
  };
  for (const Facet f : local_border_) visit(f / 4);
  if (border_.empty())  // the hole is all of the mesh
    for (std::uint32_t s = 0; s < local_.simplex_count(); ++s)
      if (!local_.is_removed(s)) visit(s);
  for (std::size_t k = 0; k != filling_.size();) {  // which grow
    const std::uint32_t s = filling_[k++];
    const auto& simplex = local_.simplex(s);
    for (std::size_t c = 0; c < mesh_.corners; ++c) {
      if (!local_.is_frame(simplex.corner[c])) has_simplex[simplex.corner[c]] = 1;
      if (is_border_[mesh_.facet(s, c)] == 0 && simplex.across[c] != mesh_.outside)
        visit(simplex.across[c] / 4);
    }
  }
  for (std::size_t b = 0; b < border_.size(); ++b) {
    const Facet beyond = local_.across(local_border_[b]), there = mesh_.across(border_[b]);
    if (beyond != mesh_.outside && made_[beyond / 4] != mesh_.none) return false;
    if (there != mesh_.outside && mesh_.opposite(there) == global(local_.opposite(local_border_[b])))
      return false;
  }
  for (std::uint32_t site = 0; site < sites_.size(); ++site)
    if (has_simplex[site] == 0 && local_.simplex_at(site) != mesh_.none) return false;
  return true;
}

template <int D>
void Hole<D>::replace(Flipper<D>& flipper) {
  std::vector<Facet> outside;
  for (const Facet f : border_) outside.push_back(mesh_.across(f));
  for (const std::uint32_t s : simplices_) {
    mesh_.remove(s);
    flipper.forget(s);
  }
  for (const std::uint32_t s : filling_) {
    made_[s] = mesh_.add(global(local_.simplex(s).corner));
    flipper.added().push_back(made_[s]);
  }
  for (const std::uint32_t s : filling_)
    for (std::size_t k = 0; k < mesh_.corners; ++k) {
      if (is_border_[mesh_.facet(s, k)] != 0) continue;
      const Facet next = local_.simplex(s).across[k];
      mesh_.link(mesh_.facet(made_[s], k), mesh_.facet(made_[next / 4], next % 4));
    }
  for (std::size_t b = 0; b < border_.size(); ++b) {
    const Facet f = mesh_.facet(made_[local_border_[b] / 4], local_border_[b] % 4);
    mesh_.link(f, outside[b]);
    flipper.add_facet(f);
  }
  for (const std::uint32_t site : local_.hidden()) mesh_.hide(sites_[site], global(local_.near_hidden(site)));
}

template <int D>
std::vector<std::uint32_t> Hole<D>::fill(Flipper<D>& flipper) {
  std::vector<Site> sites;
  for (const std::uint32_t site : sites_) sites.push_back(mesh_.sites()[site]);
  std::array<Site, D + 1> frame;
  std::copy_n(mesh_.sites().end() - frame.size(), frame.size(), frame.begin());
  local_.build(std::move(sites), frame);
  const std::vector<Facet> missing = find_border();
  if (!missing.empty()) return sites_of(missing);
  if (!flood()) return sites_of(border_);
  replace(flipper);
  return {};
}

}  // namespace

template <int D>
std::size_t refill_around(DualMesh<D>& mesh, Flipper<D>& flipper, std::vector<std::uint32_t> sites) {
  constexpr int most_rounds = 12;
  const std::size_t most_sites = mesh.site_count() / 4 + 100;
  std::size_t refilled = 0, covered = 0;
  std::unordered_set<std::uint32_t> open(sites.begin(), sites.end());
  for (int round = 0; !open.empty(); ++round) {
    if (round == most_rounds) throw MeshUnusable();
    std::unordered_set<std::uint32_t> next, done;
    sites.assign(open.begin(), open.end());
    std::sort(sites.begin(), sites.end());
    for (const std::uint32_t site : sites) {
      if (done.contains(site) || mesh.simplex_at(site) == mesh.none) continue;
      Hole<D> hole(mesh, site, open);
      done.insert(hole.inner_sites().begin(), hole.inner_sites().end());
      covered += hole.site_count();
      if (covered > most_sites) throw MeshUnusable();
      const std::vector<std::uint32_t> more = hole.fill(flipper);
      if (more.empty()) {
        refilled += hole.inner_sites().size();
        continue;
      }
      next.insert(hole.inner_sites().begin(), hole.inner_sites().end());
      next.insert(more.begin(), more.end());
    }
    open = std::move(next);
  }
  return refilled;
}

template std::size_t refill_around(DualMesh<2>&, Flipper<2>&, std::vector<std::uint32_t>);
template std::size_t refill_around(DualMesh<3>&, Flipper<3>&, std::vector<std::uint32_t>);

}  // namespace powercell
