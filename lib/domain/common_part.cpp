#include "lib/domain/common_part.hpp"

#include <algorithm>
#include <vector>

#include "lib/domain/region_mesh.hpp"

namespace powercell {
namespace {

using Tetrahedron = std::array<Vector, 4>;

/// A plane or line: the points x with n·x = offset.
struct Plane {
  Vector n;
  long double offset;
  long double side(const Vector& x) const { return dot(n, x) - offset; }  // above 0 outside
};

Vector meet(const Vector& in, long double s_in, const Vector& out, long double s_out) {
  return in + (s_in / (s_in - s_out)) * (out - in);
}

/// Appends the tetrahedra that make up the part of one inside the plane.
void clip(const Tetrahedron& t, const Plane& plane, std::vector<Tetrahedron>& out) {
  std::array<Vector, 4> in, lost;
  std::array<long double, 4> s_in{}, s_lost{};
  std::size_t kept = 0, cut = 0;
  for (const Vector& x : t) {
    const long double s = plane.side(x);
    if (s <= 0) {
      in[kept] = x, s_in[kept++] = s;
    } else {
      lost[cut] = x, s_lost[cut++] = s;
    }
  }
  const auto at = [&](std::size_t i, std::size_t j) { return meet(in[i], s_in[i], lost[j], s_lost[j]); };
  if (kept == 4) out.push_back(t);
  if (kept == 1) out.push_back({in[0], at(0, 0), at(0, 1), at(0, 2)});
  if (kept != 2 && kept != 3) return;
  // A prism with the triangles p and q.
  const std::array<Vector, 3> p =
      kept == 2 ? std::array{in[0], at(0, 0), at(0, 1)} : std::array{in[0], in[1], in[2]};
  const std::array<Vector, 3> q =
      kept == 2 ? std::array{in[1], at(1, 0), at(1, 1)} : std::array{at(0, 0), at(1, 0), at(2, 0)};
  out.insert(out.end(), {{p[0], p[1], p[2], q[2]}, {p[0], p[1], q[1], q[2]}, {p[0], q[0], q[1], q[2]}});
}

Vector dominant(const Vector& n) {
  const Vector size{std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])};
  const auto k = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  Vector axis{};
  axis[k] = n[k] < 0 ? -1 : 1;
  return axis;
}

/// The part of a convex polygon inside a line.
std::vector<Vector> clip(const std::vector<Vector>& ring, const Plane& line) {
  std::vector<Vector> kept;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vector &x = ring[k], &y = ring[(k + 1) % ring.size()];
    const long double s = line.side(x), t = line.side(y);
    if (s <= 0) kept.push_back(x);
    if ((s < 0 && t > 0) || (s > 0 && t < 0)) kept.push_back(meet(x, s, y, t));
  }
  return kept;
}

}  // namespace

CommonPart common_part(const std::array<Vector, 4>& a, const std::array<Vector, 4>& b) {
  const Vector origin = b[0];
  Tetrahedron moved = a;
  for (Vector& x : moved) x = x - origin;
  std::vector<Tetrahedron> parts{moved}, next;
  for (const auto& facet : tetrahedron_facet) {
    const Vector p = b[facet[0]] - origin, q = b[facet[1]] - origin, r = b[facet[2]] - origin;
    const Vector n = cross(q - p, r - p);
    next.clear();
    for (const Tetrahedron& part : parts) clip(part, {n, dot(n, p)}, next);
    parts.swap(next);
  }
  CommonPart common;
  for (const Tetrahedron& t : parts) {
    const long double volume = std::fabs(dot(t[1] - t[0], cross(t[2] - t[0], t[3] - t[0]))) / 6;
    common.measure += volume;
    common.centroid = common.centroid + (volume / 4) * (t[0] + t[1] + (t[2] + t[3]));
  }
  if (common.measure > 0) common.centroid = origin + (1 / common.measure) * common.centroid;
  return common;
}

CommonPart common_part(const std::array<Vector, 3>& a, const std::array<Vector, 3>& b) {
  const Vector origin = a[0], n = cross(a[1] - a[0], a[2] - a[0]), axis = dominant(n);
  std::vector<Vector> ring;
  for (const Vector& x : b) {
    const Vector y = x - origin;
    ring.push_back(y - (dot(n, y) / dot(n, axis)) * axis);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector p = a[k] - origin, outwards = cross(a[(k + 1) % 3] - a[k], n);
    ring = clip(ring, {outwards, dot(outwards, p)});
  }
  CommonPart common;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const long double area = norm(cross(ring[k] - ring[0], ring[k + 1] - ring[0])) / 2;
    common.measure += area;
    common.centroid = common.centroid + (area / 3) * (ring[0] + ring[k] + ring[k + 1]);
  }
  if (common.measure > 0) common.centroid = origin + (1 / common.measure) * common.centroid;
  return common;
}

}  // namespace powercell
