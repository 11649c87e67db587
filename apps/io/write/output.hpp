/// \file
/// Writing a diagram in any format.
#pragma once

#include <cstdint>
#include <optional>
#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <span>
#include <string>
#include <string_view>

#include "apps/io/maps/frame.hpp"
#include "apps/io/picture/style.hpp"

namespace powercell::io {

/// Where there are cells of some seeds only, of these, row by row: their indices, by which borders name
/// seeds, and the numbers that a file has for them.
struct SelectedRows {
  std::span<const std::uint32_t> seed;
  std::span<const std::uint64_t> id;
};

/// A computed diagram of n seeds. Nothing is owned.
struct DiagramOutput {
  const Domain& domain;
  SeedsView seeds;
  const Measures& measures;
  const Cells& cells;  ///< empty for a solid, which has no regions to cut cells along
  const JoinedCells& joined;
  const Adjacency& adjacency;
  /// Whether flat pictures show a weight w as a disc of radius sqrt(w). It makes no sense for weights that
  /// are determined up to a constant, such as those of a transport.
  bool weights_as_discs = true;
  InputView inputs = {};
  /// Whether a .vtu of a volume has one polyhedron for each cell in place of one for each convex piece.
  bool whole_cells = false;
  PictureStyle style = {};
  std::optional<SelectedRows> rows = {};  ///< for a .vtu; without, row k is of seed k
};

/// Extensions that `write_output` accepts: ".svg .png ...".
std::string_view known_outputs();
/// \throw Error invalid_file for another extension
void check_output_format(const std::string& path);
/// Checks before a long computation that `write_output` accepts the file for this domain and number of seeds.
/// \throw Error invalid_file (unknown extension), unsupported (a format that cannot hold such cells, a page
/// of too many)
void check_output(const std::string& path, const Domain& domain, std::size_t seeds);

/// Writes a picture (.svg .png .pdf), geometry (.vtu .vtp .obj .ply .off .stl .msh .tess .geojson),
/// everything (.json) or a page for a browser (.html), by the extension of `path`.
/// \throw Error as check_output; write_failed
void write_output(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
