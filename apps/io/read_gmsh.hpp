/// \file
/// What the two versions of Gmsh's format share.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "apps/io/read_bytes.hpp"
#include "apps/io/read_mesh.hpp"
#include "apps/io/read_text.hpp"

namespace powercell::io {

/// A kind of element: its number of nodes and what becomes of it.
struct GmshElement {
  int nodes = 0;
  int dimension = 0;
  bool linear = false;  ///< of first order: the corners are all its nodes
  const char* name = "";
};

/// Null where Gmsh's number of the kind is not known.
const GmshElement* gmsh_element(std::int64_t type);

/// Numbers of a section, from text or bytes.
class GmshNumbers {
 public:
  GmshNumbers(TextScanner& text, bool ascii, std::endian order)
      : text_(text), ascii_(ascii), bytes_(text.text(), text.name(), order) {}

  bool ascii() const { return ascii_; }
  void enter();  ///< binary: begins after the line end that follows the section's name or its count
  void leave();  ///< binary: the text goes on where the bytes ended
  double real(Item item);
  std::int64_t integer(Item item);  ///< 4 bytes in binary
  std::uint64_t size(Item item);    ///< 8 bytes in binary (a size_t)
  std::uint64_t text_count(const char* what) { return text_.count({what, 0}); }  ///< text in either case
  /// \param words and bytes that one thing takes at least
  void check(std::uint64_t count, std::size_t words, std::size_t bytes, const char* things);
  [[noreturn]] void fail(const std::string& what) const;

 private:
  TextScanner& text_;
  bool ascii_;
  ByteScanner bytes_;
};

/// Gmsh numbers its nodes as it likes: from the number in the file to the place in `vertices`.
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

/// Puts one element into the mesh. \param nodes as many places in `vertices` as the kind has nodes
void add_gmsh_element(const GmshElement& kind, const std::uint32_t* nodes, std::uint64_t tag, MeshFile& mesh);

/// The kind numbered `type`; refuses kinds that are not known or curved faces of second order.
const GmshElement& known_gmsh_element(std::int64_t type, GmshNumbers& numbers);

void read_gmsh2_nodes(GmshNumbers& numbers, GmshNodes& nodes, MeshFile& mesh);
void read_gmsh2_elements(GmshNumbers& numbers, const GmshNodes& nodes, MeshFile& mesh);
void read_gmsh4_nodes(GmshNumbers& numbers, GmshNodes& nodes, MeshFile& mesh);
void read_gmsh4_elements(GmshNumbers& numbers, const GmshNodes& nodes, MeshFile& mesh);

}  // namespace powercell::io
