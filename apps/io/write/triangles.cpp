#include "apps/io/write/triangles.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <powercell/error.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/read/file.hpp"

namespace powercell::io {
namespace {

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
  for (const double x : mesh.vertices) file.raw(x);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    file.raw(std::uint8_t{3});
    for (std::size_t k = 0; k < 3; ++k) file.raw(static_cast<std::int32_t>(mesh.triangles[t + k]));
  }
}

void write_stl_triangles(AtomicFile& file, const TriangleMesh& mesh) {
  static_assert(std::endian::native == std::endian::little, "STL is little-endian");
  std::string header = "triangle mesh by powercell";
  header.resize(80, ' ');
  file.write(header);
  file.raw(static_cast<std::uint32_t>(mesh.triangles.size() / 3));
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    double p[3][3], n[3], size = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) p[c][k] = mesh.vertices[3 * std::size_t{mesh.triangles[t + c]} + k];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      n[k] = (p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
      size += n[k] * n[k];
    }
    for (const double x : n) file.raw(static_cast<float>(size > 0 ? x / std::sqrt(size) : 0));
    for (const auto& corner : p)
      for (const double x : corner) file.raw(static_cast<float>(x));
    file.raw(std::uint16_t{0});
  }
}

float single(double x) {
  if (std::fabs(x) <= std::numeric_limits<float>::max()) return static_cast<float>(x);
  return std::numeric_limits<float>::infinity();
}

/// STL has single precision.
/// \throw Error write_failed if that changes an edge by more than half of its length, so that triangles may
/// lose their area or fold over
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
                  path + ": STL has single precision, which is not enough for triangle " +
                      std::to_string(t / 3) + "; write .ply, or scale the surface and move it to the origin");
    }
}

}  // namespace

void check_triangle_output(const std::string& path) {
  check_extension(path, std::string(triangle_files) + " .png");
}

void write_triangles(const std::string& path, const TriangleMesh& mesh) {
  check_extension(path, triangle_files);
  const std::string extension = lower_extension(path);
  if (extension == ".stl") require_single_precision(path, mesh);
  AtomicFile file(path);
  if (extension == ".off") write_off_triangles(file, mesh);
  if (extension == ".obj") write_obj_triangles(file, mesh);
  if (extension == ".ply") write_ply_triangles(file, mesh);
  if (extension == ".stl") write_stl_triangles(file, mesh);
  file.commit();
}

}  // namespace powercell::io
