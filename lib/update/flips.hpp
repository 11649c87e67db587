/// \file
/// Flips: a few simplices that share a facet are replaced by others with the same corners. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/update/mesh.hpp"

namespace powercell {

/// Flips facets of a mesh until none is broken, or no flip helps.
template <int D>
class Flipper {
 public:
  using Facet = typename DualMesh<D>::Facet;

  explicit Flipper(DualMesh<D>& mesh) : mesh_(mesh), inverted_(mesh.simplex_count()) {}

  void add_facet(Facet f) { open_.push_back(f); }
  void add_facets_of(std::uint32_t s) {
    for (std::size_t k = 0; k < mesh_.corners; ++k) add_facet(mesh_.facet(s, k));
  }
  void add_inverted(std::uint32_t s) {
    inverted_[s] = 1;
    inverted_list_.push_back(s);
  }
  /// \throw MeshUnusable in a tie, or after more flips than a mesh that can be repaired needs
  void run();
  std::size_t flips() const { return flips_; }

  /// After run(): the sites about which the mesh is still broken. Forgets what is broken there.
  std::vector<std::uint32_t> take_stuck_sites();
  /// To be called for a simplex that was added to or removed from the mesh in between.
  void forget(std::uint32_t s) {
    if (s < inverted_.size()) inverted_[s] = 0;
  }
  /// Simplices that were added; some may be removed again.
  std::vector<std::uint32_t>& added() { return added_; }

 private:
  using Corners = typename DualMesh<D>::Corners;
  struct Flip;

  bool is_inverted(std::uint32_t s) const { return s < inverted_.size() && inverted_[s] != 0; }
  bool is_broken(Facet f) const;
  bool flip(Facet f);
  bool find_third_simplices(Flip& flip) const;
  bool find_outer_facets(Flip& flip) const;
  bool is_valid(const Flip& flip) const;
  void apply(const Flip& flip);
  bool flip_open_facets();
  bool flip_inverted();

  DualMesh<D>& mesh_;
  std::vector<std::uint8_t> inverted_;  // by simplex
  std::vector<std::uint32_t> inverted_list_;
  std::vector<Facet> open_, stuck_;
  std::vector<std::uint32_t> added_;
  std::size_t flips_ = 0;
};

extern template class Flipper<2>;
extern template class Flipper<3>;

}  // namespace powercell
