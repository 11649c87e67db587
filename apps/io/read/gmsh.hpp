/// \file
/// Common parts of the readers of Gmsh's two format versions.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "apps/io/read/bytes.hpp"
#include "apps/io/read/mesh.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {

/// A kind of element.
struct GmshElement {
  int nodes = 0;
  int dimension = 0;
  bool linear = false;  ///< of first order: all nodes are corners
  const char* name = "";
};

/// Reads the numbers of a section from text or bytes.
class GmshNumbers {
 public:
  GmshNumbers(TextScanner& text, bool ascii, std::endian order)
      : text_(text), ascii_(ascii), bytes_(text.text(), text.name(), order) {}

  bool ascii() const { return ascii_; }
  void enter();  ///< binary: starts after the line end behind the section's name or count
  void leave();  ///< binary: continues the text where the bytes ended
  double real(Item item);
  std::int64_t integer(Item item);  ///< 4 bytes in binary
  std::uint64_t size(Item item);    ///< 8 bytes in binary (a size_t)
  std::uint64_t text_count(const char* what) {
    return text_.count({what, 0});
  }  ///< text also in binary files
  /// \param words, bytes  the least that one item takes as text or in binary
  void check(std::uint64_t count, std::size_t words, std::size_t bytes, const char* things);
  [[noreturn]] void fail(const std::string& what) const;

 private:
  TextScanner& text_;
  bool ascii_;
  ByteScanner bytes_;
};

/// Maps the node numbers of a file, which may be any, to indices of vertices.
class GmshNodes {
 public:
  void add(std::uint64_t tag, std::size_t place) {
    place_of_.emplace(tag, static_cast<std::uint32_t>(place));
  }
  void reserve(std::size_t count) { place_of_.reserve(count); }
  std::uint32_t at(std::uint64_t tag, GmshNumbers& numbers, std::uint64_t element) const;

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> place_of_;
};

/// Adds an element to the mesh.
/// \param nodes  indices of vertices, as many as the kind has nodes
void add_gmsh_element(const GmshElement& kind, const std::uint32_t* nodes, std::uint64_t tag, MeshFile& mesh);

/// The element of Gmsh's number `type`; refuses unknown numbers.
const GmshElement& known_gmsh_element(std::int64_t type, GmshNumbers& numbers);

void read_gmsh2_nodes(GmshNumbers& numbers, GmshNodes& nodes, MeshFile& mesh);
void read_gmsh2_elements(GmshNumbers& numbers, const GmshNodes& nodes, MeshFile& mesh);
void read_gmsh4_nodes(GmshNumbers& numbers, GmshNodes& nodes, MeshFile& mesh);
void read_gmsh4_elements(GmshNumbers& numbers, const GmshNodes& nodes, MeshFile& mesh);

}  // namespace powercell::io
