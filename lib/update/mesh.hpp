/// \file
/// The dual mesh: the regular triangulation of the seeds, with the space around it. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lib/update/predicates.hpp"

namespace powercell {

/// Triangles (D = 2) or tetrahedra (D = 3) that fill the convex hull of the sites, and for each facet of the
/// hull an infinite simplex whose remaining corner is `infinite`. So each simplex has a neighbour across each
/// of its facets. Corners are in positive order; an infinite simplex is ordered as if its infinite corner
/// were a point beyond its facet. Sites without a simplex have no cell anywhere: they are hidden.
template <int D>
class DualMesh {
 public:
  static constexpr std::uint32_t infinite = ~std::uint32_t{0}, none = infinite - 1;
  static constexpr std::size_t corners = D + 1;
  using Corners = std::array<std::uint32_t, corners>;
  struct Simplex {
    Corners corner;
    Corners across;  ///< 4 x the neighbour across the facet opposite each corner + its corner there
  };
  /// One of the facets of a simplex: 4 x the simplex + the corner opposite.
  using Facet = std::uint32_t;
  static Facet facet(std::uint32_t simplex, std::size_t corner) {
    return 4 * simplex + static_cast<std::uint32_t>(corner);
  }

  /// The mesh of all sites. \throw MeshUnusable if they tie, or do not span the space
  void build(std::vector<Site> sites);
  /// Adds a site that has no simplex. The mesh must be regular and stays so.
  /// \param near  a site with a simplex, near the new one
  /// \return whether the site has a cell; else it stays hidden
  bool insert(std::uint32_t site, std::uint32_t near);

  std::size_t site_count() const { return sites_.size(); }
  std::span<const Site> sites() const { return sites_; }
  std::span<Site> sites() { return sites_; }
  std::size_t simplex_count() const { return simplex_.size(); }  ///< those removed included
  const Simplex& simplex(std::uint32_t s) const { return simplex_[s]; }
  bool is_removed(std::uint32_t s) const { return simplex_[s].corner[0] == none; }
  bool is_infinite(std::uint32_t s) const { return infinite_corner(s) < corners; }
  std::size_t infinite_corner(std::uint32_t s) const { return index_of(simplex_[s].corner, infinite); }
  static std::size_t index_of(const Corners& corner, std::uint32_t site) {
    std::size_t k = 0;
    while (k < corners && corner[k] != site) ++k;
    return k;
  }
  /// A simplex at a site, or `none` if the site is hidden.
  std::uint32_t simplex_at(std::uint32_t site) const { return at_[site]; }
  /// A site with a simplex that is near a hidden one.
  std::uint32_t near_hidden(std::uint32_t site) const;
  const std::vector<std::uint32_t>& hidden() const { return hidden_; }

  // For repairs.
  std::array<const Site*, corners> places(std::uint32_t s) const;
  /// The orientation of finite corners.
  int orientation_of(const Corners& corner) const;
  /// Whether a site is in conflict with a simplex: +1 if it lies within the sphere orthogonal to the corners,
  /// or beyond the facet of an infinite simplex; 0 in a tie.
  int conflict(std::uint32_t s, std::uint32_t site) const;
  std::uint32_t add(const Corners& corner);
  void remove(std::uint32_t s);
  void link(Facet a, Facet b) {
    simplex_[a / 4].across[a % 4] = b;
    simplex_[b / 4].across[b % 4] = a;
  }
  Facet across(Facet f) const { return simplex_[f / 4].across[f % 4]; }
  void set_simplex_at(std::uint32_t site, std::uint32_t s) {
    if (site != infinite) at_[site] = s;
  }
  /// The site has no simplex any more.
  void hide(std::uint32_t site, std::uint32_t near);
  /// Takes the list of hidden sites away, to be filled again.
  std::vector<std::uint32_t> take_hidden() { return std::exchange(hidden_, {}); }

 private:
  void build_first();
  std::vector<std::uint32_t> spanning_sites() const;
  std::uint32_t locate(std::uint32_t site, std::uint32_t start) const;
  void find_cavity(std::uint32_t site, std::uint32_t start);
  void fill_cavity(std::uint32_t site);
  bool in_cavity(std::uint32_t s) const { return mark_[s] == epoch_; }

  std::vector<Site> sites_;
  std::vector<Simplex> simplex_;
  std::vector<std::uint32_t> at_;    // per site: a simplex, or none
  std::vector<std::uint32_t> near_;  // per site, where hidden: a site near it
  std::vector<std::uint32_t> hidden_;
  std::vector<std::uint32_t> free_;
  // Scratch memory of insert(). A simplex of the cavity has the mark epoch_, one found outside epoch_ + 1.
  std::vector<std::uint32_t> mark_;
  std::uint32_t epoch_ = 2;
  std::vector<std::uint32_t> cavity_;
  std::vector<Facet> border_;  // facets of the cavity, from inside
};

extern template class DualMesh<2>;
extern template class DualMesh<3>;

}  // namespace powercell
