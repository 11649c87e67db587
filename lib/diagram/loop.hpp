/// \file
/// When a diagram keeps its dual mesh, and what it computes from it. Internal.
#pragma once

#include <memory>
#include <optional>

#include "lib/diagram/clip.hpp"
#include "lib/update/kept_diagram.hpp"

namespace powercell {

/// A diagram that gets new weights or places again and again is in a loop. To make a mesh takes as long as a
/// diagram without it, so one is made when the second change has come. Where a mesh turns out to be of no
/// use, because seeds tie or change too much, twice as many diagrams are computed without one before the next
/// try.
class Loop {
 public:
  /// To be called when the seeds are replaced.
  /// \param same_seeds    as many seeds as before, by the same ranks but for a new order along the curve
  /// \param was_computed  whether anything was computed of those before
  void seeds_changed(bool same_seeds, bool was_computed);
  /// To be called when places change but ranks do not, or when ranks change.
  void places_changed() { moved_ = true; }
  void ranks_changed() { mesh_.reset(); }
  bool has_mesh() const { return mesh_ != nullptr; }

  /// Computes the measures and the adjacency, if wanted, from the mesh, which is made or brought up to date.
  /// \return nothing if they must be computed without one
  std::optional<KeptDiagram::Results> compute(const Setup& setup, const Input& input, bool adjacency,
                                              Timings& timings);

 private:
  /// Whether diagrams can be kept, and this one is to be.
  bool is_due(const Setup& setup, const Input& input);
  void fail();

  std::unique_ptr<KeptDiagram> mesh_;
  bool is_current_ = false;            // the mesh is that of the seeds as they are
  bool moved_ = false;                 // places have changed since the mesh was brought up to date
  int changes_ = 0;                    // of the same seeds
  unsigned wait_ = 0, next_wait_ = 1;  // diagrams to compute without a mesh: now, and after the next failure
};

}  // namespace powercell
