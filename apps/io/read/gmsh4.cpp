// Sections of Gmsh's format 4.1: a block of nodes and one of elements for each entity of the geometry.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/io/read/gmsh.hpp"

namespace powercell::io {
namespace {

struct Totals {
  std::uint64_t blocks, things;
};

Totals read_totals(GmshNumbers& numbers, std::size_t words, std::size_t bytes, const char* things) {
  const std::uint64_t blocks = numbers.size({"number of blocks", 0});
  const std::uint64_t count = numbers.size({things, 0});
  numbers.size({"least tag", 0});
  numbers.size({"greatest tag", 0});
  numbers.check(count, words, bytes, things);
  return {blocks, count};
}

void check_sum(GmshNumbers& numbers, std::uint64_t got, std::uint64_t announced, const char* things) {
  if (got != announced)
    numbers.fail(fmt::format("the blocks hold {} {}, but {} are announced", got, things, announced));
}

}  // namespace

void read_gmsh4_nodes(GmshNumbers& numbers, GmshNodes& nodes, MeshFile& mesh) {
  const Totals totals = read_totals(numbers, 4, 32, "nodes");
  nodes.reserve(totals.things);
  mesh.vertices.reserve(3 * totals.things);
  std::uint64_t done = 0;
  for (std::uint64_t block = 0; block < totals.blocks; ++block) {
    const std::int64_t dimension = numbers.integer({"block of nodes", block});
    numbers.integer({"block of nodes", block});
    const bool parametric = numbers.integer({"block of nodes", block}) != 0;
    const std::uint64_t count = numbers.size({"block of nodes", block});
    numbers.check(count, 4, 32, "nodes");
    if (dimension < 0 || dimension > 3)
      numbers.fail(fmt::format("block of nodes {}: dimension {}", block, dimension));
    for (std::uint64_t k = 0; k < count; ++k) nodes.add(numbers.size({"node", done + k}), done + k);
    for (std::uint64_t k = 0; k < count; ++k) {
      for (int axis = 0; axis < 3; ++axis) mesh.vertices.push_back(numbers.real({"node", done + k}));
      for (int k2 = 0; parametric && k2 < dimension; ++k2) numbers.real({"node", done + k});
    }
    done += count;
  }
  check_sum(numbers, done, totals.things, "nodes");
}

void read_gmsh4_elements(GmshNumbers& numbers, const GmshNodes& nodes, MeshFile& mesh) {
  const Totals totals = read_totals(numbers, 2, 16, "elements");
  std::array<std::uint32_t, 27> places;
  std::uint64_t done = 0;
  for (std::uint64_t block = 0; block < totals.blocks; ++block) {
    numbers.integer({"block of elements", block});
    numbers.integer({"block of elements", block});
    const GmshElement& kind = known_gmsh_element(numbers.integer({"block of elements", block}), numbers);
    const std::uint64_t count = numbers.size({"block of elements", block});
    numbers.check(count, 1 + kind.nodes, 8 * (1 + kind.nodes), "elements");
    for (std::uint64_t e = 0; e < count; ++e) {
      const std::uint64_t tag = numbers.size({"element", done + e});
      for (int k = 0; k < kind.nodes; ++k) places[k] = nodes.at(numbers.size({"element", tag}), numbers, tag);
      add_gmsh_element(kind, places.data(), tag, mesh);
    }
    done += count;
  }
  check_sum(numbers, done, totals.things, "elements");
}

}  // namespace powercell::io
