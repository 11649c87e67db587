/// \file
/// Bytes read as choices and hostile numbers, and the domains and seeds made of them.
#pragma once

#include <powercell/domain.hpp>
#include <vector>

#include "tests/fuzz/targets.hpp"

namespace powercell::fuzz {

/// Reads from the front; after the end everything is 0.
class Input {
 public:
  explicit Input(Bytes bytes) : bytes_(bytes) {}

  std::uint8_t byte();
  std::size_t below(std::size_t count);  ///< in [0, count); one byte
  bool flag() { return (byte() & 1) != 0; }
  /// One byte says what comes: up to 207 a multiple of 1/8 in [-13, 13) (degenerate positions are likely),
  /// up to 223 the same moved by a few last places, up to 239 any eight bytes, else a number known to hurt.
  double number();
  std::vector<double> numbers(std::size_t count);
  bool at_end() const { return at_ >= bytes_.size(); }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

/// The arrays of a domain as a caller has them, good or not.
struct DomainInput {
  enum class Kind { polygon, surface, volume, box };
  Kind kind = Kind::box;
  std::vector<PolygonPart> parts;       ///< polygon
  std::vector<double> vertices;         ///< surface, volume; box: low, then high
  std::vector<std::uint32_t> elements;  ///< surface, volume
};

/// Any domain of up to some ten elements.
DomainInput any_domain(Input& input);
/// One of a few good domains: unit boxes, a polygon with a hole, an octahedron's surface, two tetrahedra;
/// some far from the origin, small or large.
DomainInput good_domain(Input& input);

/// \throw Error where the library refuses
Domain make(const DomainInput& from);

/// Positions and weights of `count` seeds near the domain, or anywhere.
struct SeedInput {
  std::vector<double> positions, weights;
};
SeedInput any_seeds(Input& input, const Domain& domain, std::size_t count);

/// Fails unless a refusal is one that a reader can use: a message on one line, of printable characters.
void require_readable(const std::string& message);

}  // namespace powercell::fuzz
