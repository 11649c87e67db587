/// \file
/// The dual mesh: the regular triangulation of the seeds, with the space around it. Internal.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lib/update/predicates.hpp"

namespace powercell {

/// The regular triangulation of the sites and a few more far around them, the frame: triangles (D = 2) or
/// tetrahedra (D = 3) that fill the frame, a simplex. Corners are in positive order. Since the frame does not
/// move, positive simplices that are glued along facets cover it once. Sites without a simplex have no cell:
/// they are hidden.
///
/// The frame is so far away that none of its points has a cell near the sites (FarFrame), so in a domain
/// there the diagram is that of the sites alone.
template <int D>
class DualMesh {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  static constexpr std::size_t corners = D + 1;
  using Corners = std::array<std::uint32_t, corners>;
  struct Simplex {
    Corners corner;
    Corners across;  ///< the facet opposite each corner, as a facet of the neighbour; or `outside`
  };
  /// One of the facets of a simplex: 4 x the simplex + the corner opposite.
  using Facet = std::uint32_t;
  static constexpr Facet outside = ~Facet{0};  ///< beyond the frame
  static Facet facet(std::uint32_t simplex, std::size_t corner) {
    return 4 * simplex + static_cast<std::uint32_t>(corner);
  }

  /// The mesh of all sites. \param frame  \throw MeshUnusable if they tie
  void build(std::vector<Site> sites, const std::array<Site, corners>& frame);
  /// Adds a site that has no simplex. The mesh must be regular and stays so.
  /// \param near  a site with a simplex, near the new one
  /// \param added  if not null, the new simplices are appended
  /// \return whether the site has a cell; else it stays hidden
  /// \throw MeshUnusable in a tie, or if the site is at the place of another
  bool insert(std::uint32_t site, std::uint32_t near, std::vector<std::uint32_t>* added = nullptr);

  /// Numbers the simplices by their lowest sites, which are near each other in Hilbert order: so those that
  /// are used together lie together in memory.
  void sort_simplices();

  std::size_t site_count() const { return sites_.size() - corners; }
  bool is_frame(std::uint32_t site) const { return site >= site_count(); }
  /// The sites, then those of the frame.
  std::span<const Site> sites() const { return sites_; }
  std::span<Site> sites() { return sites_; }
  std::size_t simplex_count() const { return simplex_.size(); }  ///< those removed included
  const Simplex& simplex(std::uint32_t s) const { return simplex_[s]; }
  bool is_removed(std::uint32_t s) const { return simplex_[s].corner[0] == none; }
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
  int orientation_of(const Corners& corner) const;
  /// As conflict_sign().
  int conflict(std::uint32_t s, std::uint32_t site) const;
  std::uint32_t add(const Corners& corner);
  void remove(std::uint32_t s);
  /// \param b  may be `outside`
  void link(Facet a, Facet b) {
    simplex_[a / 4].across[a % 4] = b;
    if (b != outside) simplex_[b / 4].across[b % 4] = a;
  }
  Facet across(Facet f) const { return simplex_[f / 4].across[f % 4]; }
  /// The corner opposite a facet.
  std::uint32_t opposite(Facet f) const { return simplex_[f / 4].corner[f % 4]; }
  /// The site has no simplex any more.
  void hide(std::uint32_t site, std::uint32_t near);
  /// Whether a simplex was added at a site since clear_changes().
  bool is_changed(std::uint32_t site) const { return changed_[site] != 0; }
  void clear_changes() { std::fill(changed_.begin(), changed_.end(), std::uint8_t{0}); }
  /// Takes the list of hidden sites away, to be filled again.
  std::vector<std::uint32_t> take_hidden() { return std::exchange(hidden_, {}); }

 private:
  std::uint32_t locate(std::uint32_t site, std::uint32_t start) const;
  void find_cavity(std::uint32_t site, std::uint32_t start);
  void fill_cavity(std::uint32_t site);
  bool in_cavity(Facet f) const { return f != outside && mark_[f / 4] == epoch_; }

  std::vector<Site> sites_;
  std::vector<Simplex> simplex_;
  std::vector<std::uint32_t> at_;      // per site: a simplex, or none
  std::vector<std::uint32_t> near_;    // per site, where hidden: a site near it
  std::vector<std::uint8_t> changed_;  // per site
  std::vector<std::uint32_t> hidden_;
  std::vector<std::uint32_t> free_;
  // Scratch memory of insert(). A simplex of the cavity has the mark epoch_, one found outside epoch_ + 1.
  std::vector<std::uint32_t> mark_;
  std::uint32_t epoch_ = 2;
  std::vector<std::uint32_t> cavity_, made_;
  std::vector<Facet> border_;  // facets of the cavity, from inside
};

/// Points far around sites and a domain. \throw as around()
template <int D>
struct FarFrame {
  std::array<Site, D + 1> points;
  std::array<double, 3> low, high;  ///< where sites may be
  double least_weight;              ///< of sites

  /// \throw MeshUnusable if coordinates or weights are too large or too small for products of five
  static FarFrame around(std::span<const Site> sites, const std::array<double, 3>& low,
                         const std::array<double, 3>& high);
  bool holds(std::span<const Site> sites) const;
};

extern template struct FarFrame<2>;
extern template struct FarFrame<3>;
extern template class DualMesh<2>;
extern template class DualMesh<3>;

}  // namespace powercell
