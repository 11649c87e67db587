#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <powercell/shapes.hpp>
#include <string>

#include "lib/base/float_environment.hpp"
#include "lib/base/vectors.hpp"

namespace powercell {
namespace {

void check_range(int value, int least, int most, const char* name) {
  if (value >= least && value <= most) return;
  throw Error(ErrorCode::invalid_argument, std::string(name) + " is " + std::to_string(value) +
                                               "; it must be from " + std::to_string(least) + " to " +
                                               std::to_string(most));
}

using Point = Vector3<double>;

Point normalized(const Point& p) {
  const double length = std::hypot(p[0], p[1], p[2]);
  return {p[0] / length, p[1] / length, p[2] / length};
}

/// The corners of an icosahedron and its faces, counter-clockwise seen from outside.
struct Icosahedron {
  std::vector<Point> corner;
  std::vector<std::array<int, 3>> face;
  std::vector<std::array<int, 2>> edge;
};

Icosahedron icosahedron() {
  Icosahedron solid;
  const double g = std::numbers::phi;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-g, g}) {
        Point p{};
        p[(axis + 1) % 3] = a;
        p[(axis + 2) % 3] = b;
        solid.corner.push_back(normalized(p));
      }
    }
  }
  auto adjacent = [&](int a, int b) { return a != b && dot(solid.corner[a], solid.corner[b]) > 0; };
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      if (!adjacent(a, b)) continue;
      solid.edge.push_back({a, b});
      for (int c = b + 1; c < 12; ++c) {
        if (!adjacent(a, c) || !adjacent(b, c)) continue;
        const Point &p = solid.corner[a], &q = solid.corner[b], &r = solid.corner[c];
        solid.face.push_back(dot(p, cross(q, r)) > 0 ? std::array{a, b, c} : std::array{a, c, b});
      }
    }
  }
  return solid;
}

/// The point of a spherical triangle with weights i, j, k (sum n). The sines of the angles that the weights
/// stand for divide edges evenly and give triangles of similar size.
Point on_sphere(const std::array<Point, 3>& corner, const std::array<int, 3>& weight) {
  const double edge = std::acos(dot(corner[0], corner[1]));
  const int n = weight[0] + weight[1] + weight[2];
  Point p{};
  for (int c = 0; c < 3; ++c) {
    const double share = std::sin(edge * weight[c] / n);
    for (int k = 0; k < 3; ++k) p[k] += share * corner[c][k];
  }
  return normalized(p);
}

/// Numbers the vertices of a subdivided icosahedron: corners, then edges, then faces.
class SphereGrid {
 public:
  SphereGrid(const Icosahedron& solid, int n) : solid_(solid), n_(n) {
    const auto inside_edge = static_cast<std::uint32_t>(n - 1);
    first_on_face_ = 12 + 30 * inside_edge;
    face_size_ = inside_edge * (inside_edge - (n > 1 ? 1 : 0)) / 2;
  }

  /// \param i, j steps from corner 0 of the face towards corners 1 and 2
  std::uint32_t index(int face, int i, int j) const {
    const auto& corner = solid_.face[face];
    const int k = n_ - i - j;
    if (k == n_) return corner[0];
    if (i == n_) return corner[1];
    if (j == n_) return corner[2];
    if (j == 0) return on_edge(corner[0], corner[1], i);
    if (i == 0) return on_edge(corner[0], corner[2], j);
    if (k == 0) return on_edge(corner[1], corner[2], j);
    const int row_start = (j - 1) * (n_ - 1) - j * (j - 1) / 2;  // rows of n-2, n-3, ... points
    return first_on_face_ + face_size_ * face + row_start + i - 1;
  }

 private:
  std::uint32_t on_edge(int from, int to, int step) const {
    if (from > to) return on_edge(to, from, n_ - step);
    const auto at = std::ranges::find(solid_.edge, std::array{from, to}) - solid_.edge.begin();
    return 12 + static_cast<std::uint32_t>(at) * (n_ - 1) + step - 1;
  }

  const Icosahedron& solid_;
  int n_;
  std::uint32_t first_on_face_, face_size_;
};

/// Vertices of the ball: the integer points with |x| + |y| + |z| <= n, in lexicographic order.
class BallGrid {
 public:
  explicit BallGrid(int n) : n_(n), side_(2 * n + 1), index_(std::size_t(side_) * side_ * side_) {
    std::uint32_t count = 0;
    for (int x = -n; x <= n; ++x) {
      for (int y = -n; y <= n; ++y) {
        for (int z = -n; z <= n; ++z) {
          const int shell = std::abs(x) + std::abs(y) + std::abs(z);
          if (shell > n) continue;
          index_[slot({x, y, z})] = count++;
          const Point p = position({x, y, z}, shell);
          vertices.insert(vertices.end(), p.begin(), p.end());
        }
      }
    }
  }
  std::uint32_t index(const std::array<int, 3>& at) const { return index_[slot(at)]; }

  std::vector<double> vertices;

 private:
  std::size_t slot(const std::array<int, 3>& at) const {
    return (std::size_t(at[0] + n_) * side_ + (at[1] + n_)) * side_ + (at[2] + n_);
  }
  /// Maps shells of the octahedron to spheres; sines divide quarter circles evenly.
  Point position(const std::array<int, 3>& at, int shell) const {
    if (shell == 0) return {};
    Point p;
    for (int k = 0; k < 3; ++k) p[k] = std::sin(std::numbers::pi / 2 * at[k] / shell);
    p = normalized(p);
    for (double& x : p) x *= static_cast<double>(shell) / n_;
    return p;
  }
  int n_, side_;
  std::vector<std::uint32_t> index_;
};

/// The tetrahedra of one octant. In the sums s0 = x+y+z, s1 = x+y, s2 = x the octant is
/// n >= s0 >= s1 >= s2 >= 0, which the six paths through each unit cube tile (Freudenthal).
void append_octant(const BallGrid& grid, int n, const std::array<int, 3>& sign,
                   std::vector<std::uint32_t>& out) {
  const bool mirrored = sign[0] * sign[1] * sign[2] < 0;
  auto index = [&](const std::array<int, 3>& s) {
    return grid.index({sign[0] * s[2], sign[1] * (s[1] - s[2]), sign[2] * (s[0] - s[1])});
  };
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b <= a; ++b) {
      for (int c = 0; c <= b; ++c) {
        std::array<int, 3> path{0, 1, 2};
        do {
          std::array<int, 3> s{a, b, c};
          std::array<std::uint32_t, 4> corner{index(s)};
          bool inside = true;
          for (int step = 0; step < 3 && inside; ++step) {
            ++s[path[step]];
            inside = s[0] >= s[1] && s[1] >= s[2];
            if (inside) corner[step + 1] = index(s);
          }
          if (!inside) continue;
          const int order = (path[0] < path[1]) + (path[1] < path[2]) + (path[2] < path[0]);
          if ((order == 2) != mirrored) std::swap(corner[2], corner[3]);
          out.insert(out.end(), corner.begin(), corner.end());
        } while (std::ranges::next_permutation(path).found);
      }
    }
  }
}

}  // namespace

Ring disk(int segments) {
  const FloatEnvironment environment;
  check_range(segments, 3, 1 << 26, "the number of segments of a disk");
  Ring ring;
  for (int k = 0; k < segments; ++k) {
    const double angle = 2 * std::numbers::pi * k / segments;
    ring.push_back({std::cos(angle), std::sin(angle)});
  }
  return ring;
}

TriangleMesh sphere(int resolution) {
  const FloatEnvironment environment;
  check_range(resolution, 1, 4096, "the resolution of a sphere");
  const int n = resolution;
  const Icosahedron solid = icosahedron();
  const SphereGrid grid(solid, n);
  TriangleMesh mesh;
  mesh.vertices.resize(3 * (10 * std::size_t(n) * n + 2));
  for (int f = 0; f < 20; ++f) {
    const auto& face = solid.face[f];
    const std::array<Point, 3> corner{solid.corner[face[0]], solid.corner[face[1]], solid.corner[face[2]]};
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i + j <= n; ++i) {
        const std::uint32_t v = grid.index(f, i, j);
        std::ranges::copy(on_sphere(corner, {n - i - j, i, j}), &mesh.vertices[3 * std::size_t{v}]);
        if (i + j == n) continue;
        const std::uint32_t right = grid.index(f, i + 1, j), up = grid.index(f, i, j + 1);
        mesh.triangles.insert(mesh.triangles.end(), {v, right, up});
        if (i + j + 1 == n) continue;
        mesh.triangles.insert(mesh.triangles.end(), {right, grid.index(f, i + 1, j + 1), up});
      }
    }
  }
  return mesh;
}

TriangleMesh torus(int resolution) {
  const FloatEnvironment environment;
  check_range(resolution, 3, 16384, "the resolution of a torus");
  const int around_tube = resolution, around_axis = (5 * resolution + 1) / 2;
  TriangleMesh mesh;
  auto index = [&](int a, int t) {
    return static_cast<std::uint32_t>(a % around_axis * around_tube + t % around_tube);
  };
  for (int a = 0; a < around_axis; ++a) {
    const double angle = 2 * std::numbers::pi * a / around_axis;
    for (int t = 0; t < around_tube; ++t) {
      const double turn = 2 * std::numbers::pi * t / around_tube;
      const double radius = 1 + 0.4 * std::cos(turn);
      mesh.vertices.insert(mesh.vertices.end(),
                           {radius * std::cos(angle), radius * std::sin(angle), 0.4 * std::sin(turn)});
      mesh.triangles.insert(mesh.triangles.end(), {index(a, t), index(a + 1, t), index(a + 1, t + 1)});
      mesh.triangles.insert(mesh.triangles.end(), {index(a, t), index(a + 1, t + 1), index(a, t + 1)});
    }
  }
  return mesh;
}

TetrahedralMesh ball(int resolution) {
  const FloatEnvironment environment;
  check_range(resolution, 1, 256, "the resolution of a ball");
  BallGrid grid(resolution);
  TetrahedralMesh mesh;
  for (int octant = 0; octant < 8; ++octant) {
    append_octant(grid, resolution, {octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1},
                  mesh.tetrahedra);
  }
  mesh.vertices = std::move(grid.vertices);
  return mesh;
}

}  // namespace powercell
