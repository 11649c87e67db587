#include "apps/io/write_triangles.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <powercell/error.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/read_file.hpp"

namespace powercell::io {
namespace {

template <class T>
void raw(AtomicFile& file, T value) {
  file.write(std::string_view(reinterpret_cast<const char*>(&value), sizeof value));
}

void write_points(AtomicFile& file, const TriangleMesh& mesh, std::string_view start) {
  for (std::size_t v = 0; v < mesh.vertices.size(); v += 3) {
    file.write(start);
    for (std::size_t k = 0; k < 3; ++k) {
      if (k > 0) file.write(' ');
      file.number(mesh.vertices[v + k]);
    }
    file.write('\n');
  }
}

/// \param first  the number of the first vertex
void write_rows(AtomicFile& file, const TriangleMesh& mesh, std::string_view start, std::uint64_t first) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    file.write(start);
    for (std::size_t k = 0; k < 3; ++k) {
      file.write(' ');
      file.number(mesh.triangles[t + k] + first);
    }
    file.write('\n');
  }
}

void write_off_triangles(AtomicFile& file, const TriangleMesh& mesh) {
  file.write("OFF\n" + std::to_string(mesh.vertices.size() / 3) + " " +
             std::to_string(mesh.triangles.size() / 3) + " 0\n");
  write_points(file, mesh, "");
  write_rows(file, mesh, "3", 0);
}

void write_obj_triangles(AtomicFile& file, const TriangleMesh& mesh) {
  write_points(file, mesh, "v ");
  write_rows(file, mesh, "f", 1);
}

void write_ply_triangles(AtomicFile& file, const TriangleMesh& mesh) {
  const bool little = std::endian::native == std::endian::little;
  file.write(std::string("ply\nformat binary_") + (little ? "little" : "big") +
             "_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size() / 3) +
             "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
             std::to_string(mesh.triangles.size() / 3) +
             "\nproperty list uchar int vertex_indices\nend_header\n");
  for (const double x : mesh.vertices) raw(file, x);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    raw(file, std::uint8_t{3});
    for (std::size_t k = 0; k < 3; ++k) raw(file, static_cast<std::int32_t>(mesh.triangles[t + k]));
  }
}

void write_stl_triangles(AtomicFile& file, const TriangleMesh& mesh) {
  static_assert(std::endian::native == std::endian::little, "STL is little-endian");
  std::string header = "triangle mesh by powercell";
  header.resize(80, ' ');
  file.write(header);
  raw(file, static_cast<std::uint32_t>(mesh.triangles.size() / 3));
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    double p[3][3], n[3], size = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) p[c][k] = mesh.vertices[3 * std::size_t{mesh.triangles[t + c]} + k];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      n[k] = (p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
      size += n[k] * n[k];
    }
    for (const double x : n) raw(file, static_cast<float>(size > 0 ? x / std::sqrt(size) : 0));
    for (const auto& corner : p)
      for (const double x : corner) raw(file, static_cast<float>(x));
    raw(file, std::uint16_t{0});
  }
}

float single(double x) {
  if (std::fabs(x) <= std::numeric_limits<float>::max()) return static_cast<float>(x);
  return std::numeric_limits<float>::infinity();
}

/// STL holds single precision. \throw Error write_failed where that changes an edge by more than half of its
/// length, so that triangles may lose their area or fold
void require_single_precision(const std::string& path, const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (std::size_t c = 0; c < 3; ++c) {
      const double* a = &mesh.vertices[3 * std::size_t{mesh.triangles[t + c]}];
      const double* b = &mesh.vertices[3 * std::size_t{mesh.triangles[t + (c + 1) % 3]}];
      double edge[3], change[3];
      for (std::size_t k = 0; k < 3; ++k) {
        edge[k] = b[k] - a[k];
        change[k] = double{single(b[k])} - double{single(a[k])} - edge[k];
      }
      if (std::hypot(change[0], change[1], change[2]) <= 0.5 * std::hypot(edge[0], edge[1], edge[2]))
        continue;
      throw Error(ErrorCode::write_failed,
                  path + ": STL holds single precision, which ruins triangle " + std::to_string(t / 3) +
                      "; write .ply, or scale the surface and move it to the origin");
    }
}

struct Format {
  std::string_view extension;
  void (*write)(AtomicFile& file, const TriangleMesh& mesh);
};
constexpr Format formats[] = {{".off", write_off_triangles},
                              {".obj", write_obj_triangles},
                              {".ply", write_ply_triangles},
                              {".stl", write_stl_triangles}};

}  // namespace

std::string_view known_triangle_files() {
  return ".off .obj .ply .stl";
}

void check_triangle_output(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".png") return;
  for (const Format& format : formats)
    if (extension == format.extension) return;
  throw Error(ErrorCode::invalid_file, path + ": unknown extension of an output file; known are " +
                                           std::string(known_triangle_files()) +
                                           " for the mesh and .png for a picture");
}

void write_triangles(const std::string& path, const TriangleMesh& mesh) {
  check_triangle_output(path);
  const std::string extension = lower_extension(path);
  for (const Format& format : formats) {
    if (extension != format.extension) continue;
    if (extension == ".stl") require_single_precision(path, mesh);
    AtomicFile file(path);
    format.write(file, mesh);
    file.commit();
    return;
  }
  throw Error(ErrorCode::invalid_file, path + ": a picture shows two meshes, this is one");
}

}  // namespace powercell::io
