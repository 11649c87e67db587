#include <algorithm>
#include <bit>
#include <limits>
#include <powercell/error.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/picture/colours.hpp"
#include "apps/io/write/formats.hpp"
#include "apps/io/write/polygons.hpp"

namespace powercell::io {
namespace {

void write_point(AtomicFile& file, const double* point) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) file.write(' ');
    file.number(point[k]);
  }
  file.write('\n');
}

std::string ply_header(const PolygonSoup& soup, bool long_faces) {
  const bool little = std::endian::native == std::endian::little;
  return std::string("ply\nformat binary_") + (little ? "little" : "big") +
         "_endian 1.0\ncomment power diagram by powercell; seed: the cell of a face\nelement vertex " +
         std::to_string(soup.vertex_count()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(soup.size()) + "\nproperty list " + (long_faces ? "uint" : "uchar") +
         " int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
         "property int seed\nend_header\n";
}

std::size_t corners(const PolygonSoup& soup, std::size_t polygon) {
  return soup.offset[polygon + 1] - soup.offset[polygon];
}

}  // namespace

void write_obj(const std::string& path, const DiagramOutput& output) {
  const PolygonSoup soup = polygon_soup(output);
  AtomicFile file(path);
  file.write("# power diagram by powercell; group cell_<seed> holds the polygons of one cell\n");
  for (std::size_t v = 0; v < soup.vertex_count(); ++v) {
    file.write("v ");
    write_point(file, &soup.vertices[3 * v]);
  }
  for (std::size_t p = 0; p < soup.size(); ++p) {
    if (p == 0 || soup.seed[p] != soup.seed[p - 1]) {
      file.write("g cell_");
      file.number(std::uint64_t{soup.seed[p]});
      file.write('\n');
    }
    file.write('f');
    for (std::uint64_t e = soup.offset[p]; e < soup.offset[p + 1]; ++e) {
      file.write(' ');
      file.number(soup.corner[e] + 1);
    }
    file.write('\n');
  }
  file.commit();
}

void write_ply(const std::string& path, const DiagramOutput& output) {
  const PolygonSoup soup = polygon_soup(output);
  if (soup.vertex_count() > std::numeric_limits<std::int32_t>::max()) {
    throw Error(ErrorCode::write_failed, path + ": PLY numbers vertices with 32 bits and this diagram has " +
                                             std::to_string(soup.vertex_count()) +
                                             " of them; write .vtp instead");
  }
  const std::vector<Colour> colours = colouring_of(output).colour;
  std::size_t most = 0;
  for (std::size_t p = 0; p < soup.size(); ++p) most = std::max(most, corners(soup, p));
  const bool long_faces = most > 255;
  AtomicFile file(path);
  file.write(ply_header(soup, long_faces));
  for (const double x : soup.vertices) file.raw(x);
  for (std::size_t p = 0; p < soup.size(); ++p) {
    if (long_faces)
      file.raw(static_cast<std::uint32_t>(corners(soup, p)));
    else
      file.raw(static_cast<std::uint8_t>(corners(soup, p)));
    for (std::uint64_t e = soup.offset[p]; e < soup.offset[p + 1]; ++e) {
      file.raw(static_cast<std::int32_t>(soup.corner[e]));
    }
    const Colour colour = colours[soup.seed[p]];
    file.raw(colour.red);
    file.raw(colour.green);
    file.raw(colour.blue);
    file.raw(static_cast<std::int32_t>(soup.seed[p]));
  }
  file.commit();
}

void write_off(const std::string& path, const DiagramOutput& output) {
  const PolygonSoup soup = polygon_soup(output);
  const std::vector<Colour> colours = colouring_of(output).colour;
  AtomicFile file(path);
  file.write("OFF\n" + std::to_string(soup.vertex_count()) + " " + std::to_string(soup.size()) + " 0\n");
  for (std::size_t v = 0; v < soup.vertex_count(); ++v) write_point(file, &soup.vertices[3 * v]);
  for (std::size_t p = 0; p < soup.size(); ++p) {
    file.number(std::uint64_t{corners(soup, p)});
    for (std::uint64_t e = soup.offset[p]; e < soup.offset[p + 1]; ++e) {
      file.write(' ');
      file.number(soup.corner[e]);
    }
    const Colour colour = colours[soup.seed[p]];
    for (const std::uint8_t c : {colour.red, colour.green, colour.blue}) {
      file.write(' ');
      file.number(std::uint64_t{c});
    }
    file.write(" # ");
    file.number(std::uint64_t{soup.seed[p]});
    file.write('\n');
  }
  file.commit();
}

}  // namespace powercell::io
