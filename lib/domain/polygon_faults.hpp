/// \file
/// What can be wrong with the rings of a polygon, in words.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "lib/domain/rings.hpp"

namespace powercell {

/// An edge of a ring.
struct RingEdge {
  std::uint32_t left, right;  ///< its ends, in the lexicographic order of vertices
  std::uint32_t ring;
  bool inside_above;  ///< the domain is above it, else below
};

/// Messages about the rings of a polygon: which of them, what is wrong, where, and what is expected.
class PolygonFaults {
 public:
  explicit PolygonFaults(const IndexedRings& rings) : rings_(rings) {}

  /// Two edges cross, none of whose ends lies on the other.
  std::string crossing(const RingEdge& e, const RingEdge& f) const;
  /// Two edges cross at a vertex.
  std::string crossing(const RingEdge& e, const RingEdge& f, std::uint32_t v) const;
  /// Two edges lie on each other from v on, of one part or with their insides on the same side.
  std::string common_edge(const RingEdge& e, const RingEdge& f, std::uint32_t v) const;
  /// A ring comes to v more than once.
  std::string meets_itself(std::uint32_t ring, std::uint32_t v) const;
  /// The rings of a part form a closed chain, which is complete at v.
  std::string cut_in_pieces(std::uint32_t part, std::uint32_t v) const;

  /// What is wrong with a place near v that these rings wind around, so and so often each; nothing if it lies
  /// in one part or in none.
  /// \pre no edges cross and no ring meets itself
  std::optional<std::string> around(const std::map<std::uint32_t, int>& winding, std::uint32_t v) const;

 private:
  std::uint32_t part(std::uint32_t ring) const { return rings_.rings[ring].part; }
  std::string at(std::uint32_t v) const { return place(rings_.at(v)[0], rings_.at(v)[1]); }
  std::string crossing_at(const RingEdge& e, const RingEdge& f, const std::string& where) const;

  const IndexedRings& rings_;
};

}  // namespace powercell
