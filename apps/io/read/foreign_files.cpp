#include "apps/io/read/foreign_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "apps/io/read/file.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

constexpr std::string_view map_extensions[] = {".kml", ".kmz", ".gml",      ".shp",     ".shx",
                                               ".dbf", ".dxf", ".topojson", ".parquet", ".fgb",
                                               ".gpx", ".osm", ".mif",      ".gdb",     ".geoparquet"};

constexpr std::string_view tetgen_extensions[] = {".node", ".ele", ".face", ".smesh"};

using Words = std::vector<std::string_view>;

/// \param comments  whether lines that begin with # count
std::vector<Words> first_lines(std::string_view text, std::size_t count, bool comments = true) {
  std::vector<Words> lines;
  while (lines.size() < count && !text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end), word;
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!comments && (trimmed(line).empty() || trimmed(line).starts_with('#'))) continue;
    lines.emplace_back();
    while (next_word(line, word)) lines.back().push_back(word);
  }
  lines.resize(count);
  return lines;
}

bool are_numbers(const Words& words, std::size_t from, std::size_t count) {
  double value = 0;
  if (words.size() < from + count) return false;
  return std::all_of(words.begin() + static_cast<std::ptrdiff_t>(from),
                     words.begin() + static_cast<std::ptrdiff_t>(from + count),
                     [&](std::string_view word) { return parse_number(word, value) == Parsed::ok; });
}

bool is_whole(std::string_view word) {
  return word.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_count(const Words& words) {
  return words.size() == 1 && is_whole(words[0]);
}

bool begins_with_letter(std::string_view word) {
  return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
}

// A number of atoms, a line of anything, and rows of an element and its coordinates.
bool is_xyz(const std::vector<Words>& lines) {
  return is_count(lines[0]) && !lines[2].empty() && begins_with_letter(lines[2][0]) &&
         are_numbers(lines[2], 1, 3);
}

// A title, a scale, three vectors, and, after elements and their counts, what the coordinates are.
bool is_poscar(const std::vector<Words>& lines) {
  if (lines[1].empty() || lines[1].size() > 3 || !are_numbers(lines[1], 0, lines[1].size())) return false;
  for (std::size_t k = 2; k < 5; ++k)
    if (!are_numbers(lines[k], 0, 3)) return false;
  return std::any_of(lines.begin() + 6, lines.begin() + 9, [](const Words& words) {
    const std::string word = words.empty() ? "" : lower_case(words[0]);
    return word.starts_with("direct") || word.starts_with("cart");
  });
}

// Nodes of TetGen or Triangle: the numbers of points, coordinates, attributes and markers, then numbered
// points.
bool is_node_file(std::string_view text) {
  const std::vector<Words> lines = first_lines(text, 3, false);
  const Words &head = lines[0], &first = lines[1];
  if (head.size() != 4 || !std::all_of(head.begin(), head.end(), is_whole)) return false;
  if (head[1] != "2" && head[1] != "3") return false;
  const std::size_t d = head[1] == "2" ? 2 : 3;
  if (first.size() <= d || (first[0] != "0" && first[0] != "1") || !are_numbers(first, 1, d)) return false;
  return !lines[2].empty() && lines[2][0] == (first[0] == "0" ? "1" : "2");
}

// Vertices of Wavefront's OBJ, or the first line of OFF or PLY.
bool is_mesh(std::string_view text) {
  const std::vector<Words> lines = first_lines(text, 20, false);
  const std::string first = lines[0].size() == 1 ? lower_case(lines[0][0]) : "";
  if (first == "ply" || first == "off" || first == "coff" || first == "noff") return true;
  return std::any_of(lines.begin(), lines.end(), [](const Words& words) {
    return words.size() > 3 && words[0] == "v" && are_numbers(words, 1, 3);
  });
}

// The file in a command that the user may copy.
std::string as_argument(const std::string& name) {
  if (name == "standard input") return "FILE";
  return name.find_first_of(" ()&;$") == std::string::npos ? name : "'" + name + "'";
}

}  // namespace

void refuse_foreign_map(const std::string& extension, const std::string& name) {
  if (std::find(std::begin(map_extensions), std::end(map_extensions), extension) == std::end(map_extensions))
    return;
  fail_file(name,
            fmt::format("maps in '{}' are not read; GDAL converts them: ogr2ogr -f GeoJSON map.geojson {}",
                        extension, as_argument(name)));
}

void refuse_foreign_mesh(const std::string& extension, const std::string& name) {
  if (std::ranges::find(tetgen_extensions, extension) != std::end(tetgen_extensions))
    fail_file(name,
              fmt::format(
                  "meshes of TetGen are not read; meshio converts those of a .node and an .ele file: meshio "
                  "convert {} mesh.vtu",
                  as_argument(name)));
}

void refuse_foreign_seeds(std::string_view text, const std::string& name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::string begin = lower_case(trimmed(text.substr(0, 64)));
  if (begin.starts_with("<?xml") || begin.starts_with("<kml") || begin.starts_with("<gpx"))
    fail_file(
        name,
        fmt::format("is XML, not a table; if it is a map such as KML, GML or GPX, GDAL converts it: ogr2ogr "
                    "-f GeoJSON points.geojson {}",
                    as_argument(name)));
  if (begin.starts_with("item: "))
    fail_file(name, fmt::format("is a dump of LAMMPS, not a table; this makes one of a single frame: sed "
                                "'1,/^ITEM: ATOMS/{{/^ITEM: ATOMS /!d;s///}}' {} >atoms.txt",
                                as_argument(name)));
  if (is_node_file(text))
    fail_file(
        name,
        fmt::format(
            "has the nodes of TetGen or Triangle, not a table; this makes one: awk '!/^#/ && NF {{if (n++) "
            "for "
            "(k = 2; k < 2 + d; k++) printf \"%s%s\", $k, k < 1 + d ? \" \" : \"\\n\"; else d = $2}}' {} "
            ">points.txt",
            as_argument(name)));
  if (is_mesh(text))
    fail_file(
        name,
        fmt::format("is a mesh or cloud of points, not a table; meshio makes one of its points: python3 -c "
                    "\"import meshio, numpy; numpy.savetxt('points.txt', meshio.read('{}').points)\"",
                    name));
  const std::vector<Words> lines = first_lines(text, 9);
  if (is_xyz(lines))
    fail_file(
        name,
        fmt::format("is an XYZ file of atoms, not a table; this makes one of its coordinates: awk 'NR > 2 "
                    "{{print $2, $3, $4}}' {} >atoms.txt",
                    as_argument(name)));
  if (is_poscar(lines))
    fail_file(
        name,
        fmt::format(
            "is a POSCAR file of VASP, not a table; ASE converts it: python3 -c \"import ase.io, numpy; "
            "numpy.savetxt('atoms.txt', ase.io.read('{}', format='vasp').positions)\"",
            name));
}

}  // namespace powercell::io
