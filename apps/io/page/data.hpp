/// \file
/// The data of a page that draws a diagram.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/atomic_file.hpp"
#include "apps/io/write/output.hpp"

namespace powercell::io {

/// The most triangles, and points, of a page: tables of 2048 x 4096 entries, which every browser with WebGL 2
/// takes in practice.
constexpr std::size_t most_in_view = std::size_t{2048} * 4096;

/// Writes elements of HTML:
///
///     <script type="application/json" id="diagram">{"powercell": version, "title", "kind", "dimension",
///       "seeds": n, "check": {"cells", "hidden", "duplicate", "measure", "domain_measure"},
///       "colour": what cells are coloured by at first, if not to tell them apart, "scale": the colours of
///       numbers, from the least on, "palette": those of classes, in the order of their texts, as "#rrggbb",
///       "frame": {"offset", "scale"}, "map": the plane's definition, if there is one,
///       "columns": [{"name", "type": "number" or "text", "values": the different texts}],
///       "arrays": {NAME: {"type", "count"}}}</script>
///     <script type="text/plain" id="array-NAME">base64 of a zlib stream</script>, for each array
///
/// Arrays: those of ViewMesh (`normals` on surfaces, `outer` in volumes), `cell_colours` (three bytes a cell,
/// as in pictures), `position`, `weight`, `status` (0 ok, 1 hidden, 2 duplicate), `measure`, `centroid`,
/// `second_moment`, `neighbors`, and of column k of the seeds' table `column<k>`: numbers, not a number where
/// the field is empty, or indices of texts. Types: `uint8`, `int8`, `float32`, `float64` (little-endian), and
/// `integers`, of which the differences of successive ones are zigzag coded (0, -1, 1, -2, ... are 0, 1, 2,
/// 3,
/// ...), seven bits a byte, low ones first, the top bit set in all bytes but the last.
///
/// Columns that hold the coordinates or weights are not repeated.
/// \throw Error unsupported if the cells have more than `most_in_view` triangles or points
void write_view_data(AtomicFile& file, const DiagramOutput& output, const std::string& title,
                     const std::string& path);

}  // namespace powercell::io
