// Sections of Gmsh's format 2: flat lists of nodes and elements.
#include <fmt/format.h>

#include <array>

#include "apps/io/read/gmsh.hpp"

namespace powercell::io {
namespace {

constexpr int most_nodes = 27;

void read_element(GmshNumbers& numbers, const GmshNodes& nodes, const GmshElement& kind, std::uint64_t tag,
                  MeshFile& mesh) {
  std::array<std::uint32_t, most_nodes> places;
  for (int k = 0; k < kind.nodes; ++k) {
    places[k] = nodes.at(static_cast<std::uint64_t>(numbers.integer({"element", tag})), numbers, tag);
  }
  add_gmsh_element(kind, places.data(), tag, mesh);
}

std::int64_t tag_count(GmshNumbers& numbers, std::uint64_t element) {
  const std::int64_t tags = numbers.integer({"element", element});
  if (tags < 0) numbers.fail(fmt::format("element {} has {} tags", element, tags));
  numbers.check(static_cast<std::uint64_t>(tags), 1, 4, "tags");
  return tags;
}

}  // namespace

void read_gmsh2_nodes(GmshNumbers& numbers, GmshNodes& nodes, MeshFile& mesh) {
  const std::uint64_t count = numbers.text_count("number of nodes");
  numbers.enter();
  numbers.check(count, 4, 28, "nodes");
  nodes.reserve(count);
  mesh.vertices.reserve(3 * count);
  for (std::uint64_t v = 0; v < count; ++v) {
    nodes.add(static_cast<std::uint64_t>(numbers.integer({"node", v})), v);
    for (int axis = 0; axis < 3; ++axis) mesh.vertices.push_back(numbers.real({"node", v}));
  }
}

void read_gmsh2_elements(GmshNumbers& numbers, const GmshNodes& nodes, MeshFile& mesh) {
  const std::uint64_t count = numbers.text_count("number of elements");
  numbers.enter();
  numbers.check(count, 4, 8, "elements");
  if (numbers.ascii()) {
    for (std::uint64_t e = 0; e < count; ++e) {
      const auto tag = static_cast<std::uint64_t>(numbers.integer({"element", e}));
      const GmshElement& kind = known_gmsh_element(numbers.integer({"element", tag}), numbers);
      for (std::int64_t k = tag_count(numbers, tag); k > 0; --k) numbers.integer({"element", tag});
      read_element(numbers, nodes, kind, tag, mesh);
    }
    return;
  }
  for (std::uint64_t done = 0; done < count;) {  // blocks of elements of one kind
    const GmshElement& kind = known_gmsh_element(numbers.integer({"element", done}), numbers);
    const std::int64_t in_block = numbers.integer({"element", done});
    const std::int64_t tags = tag_count(numbers, done);
    if (in_block < 1 || static_cast<std::uint64_t>(in_block) > count - done) {
      numbers.fail(fmt::format("a block of {} elements where {} are left", in_block, count - done));
    }
    for (std::int64_t e = 0; e < in_block; ++e) {
      const auto tag = static_cast<std::uint64_t>(numbers.integer({"element", done}));
      for (std::int64_t k = 0; k < tags; ++k) numbers.integer({"element", tag});
      read_element(numbers, nodes, kind, tag, mesh);
    }
    done += static_cast<std::uint64_t>(in_block);
  }
}

}  // namespace powercell::io
