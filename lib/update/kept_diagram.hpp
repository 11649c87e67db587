/// \file
/// A diagram kept as its dual mesh, from which the next one is computed. Internal.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <powercell/results.hpp>

#include "lib/scene/domain_buffers.hpp"
#include "lib/seeds/seed_set.hpp"
#include "lib/update/predicates.hpp"

namespace powercell {

class KeptDiagram {
 public:
  struct Results {
    Measures measures;
    std::optional<Adjacency> adjacency;
    std::uint64_t clipped = 0;  ///< cells that were clipped by their neighbours
  };

  virtual ~KeptDiagram() = default;
  /// Whether diagrams of a domain can be kept: one convex region in double precision, not periodic.
  static bool is_possible(const DomainBuffers& domain);
  /// \param domain  must outlive the result; is_possible()
  /// \param seeds  without duplicates
  /// \throw MeshUnusable if seeds tie
  static std::unique_ptr<KeptDiagram> make(const DomainBuffers& domain, const SeedSet& seeds, int threads);

  /// Takes new weights or places of the same seeds, by rank.
  /// \param moved  whether places have changed
  /// \throw MeshUnusable in a tie, or if the diagrams are too different; then this must not be used any more
  virtual void update(const SeedSet& seeds, bool moved) = 0;
  /// \throw MeshUnusable as update()
  virtual Results evaluate(const SeedSet& seeds, double domain_measure, bool adjacency) = 0;
};

}  // namespace powercell
