#include "apps/io/picture/normals.hpp"

#include <algorithm>
#include <numeric>

namespace powercell::io {

Normalization normalization(const Domain& domain) {
  const auto low = domain.low(), high = domain.high();
  Normalization result;
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    result.centre[k] = low[k] + (high[k] - low[k]) / 2;
    squared += (high[k] - low[k]) * (high[k] - low[k]);
  }
  result.scale = squared > 0 ? 2 / std::sqrt(squared) : 1;
  return result;
}

std::vector<Vec3> corner_normals(const RegionsView& mesh, const Normalization& normalize) {
  constexpr float crease = 0.8f;  // cosine of the angle from which an edge stays sharp
  const std::size_t triangles = mesh.size();
  const auto corner = [&](std::size_t c) { return &mesh.vertices[3 * std::size_t{mesh.region_vertex[c]}]; };
  std::vector<Vec3> face(triangles);  // twice the area long
  for (std::size_t t = 0; t < triangles; ++t) {
    const Vec3 a = normalize(corner(3 * t));
    face[t] = cross(normalize(corner(3 * t + 1)) - a, normalize(corner(3 * t + 2)) - a);
  }
  std::vector<std::uint32_t> order(3 * triangles);
  std::iota(order.begin(), order.end(), 0u);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare(corner(a), corner(a) + 3, corner(b), corner(b) + 3);
  };
  std::sort(order.begin(), order.end(), before);
  std::vector<Vec3> normals(3 * triangles);
  for (std::size_t begin = 0, end; begin < order.size(); begin = end) {
    for (end = begin + 1; end < order.size() && !before(order[begin], order[end]); ++end) {
    }
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 own = normalized(face[order[i] / 3]);
      Vec3 sum;
      for (std::size_t j = begin; j < end; ++j) {
        const Vec3 other = face[order[j] / 3];
        const float cosine = dot(own, normalized(other));
        if (std::abs(cosine) >= crease) sum = sum + other * (cosine > 0 ? 1.0f : -1.0f);
      }
      normals[order[i]] = normalized(sum);
    }
  }
  return normals;
}

TriangleNormals::TriangleNormals(const RegionsView& mesh, const std::vector<Vec3>& normals,
                                 const Normalization& normalize, std::uint32_t triangle) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t c = 3 * std::size_t{triangle} + k;
    corner_[k] = normalize(&mesh.vertices[3 * std::size_t{mesh.region_vertex[c]}]);
    normal_[k] = normals[c];
  }
}

Vec3 TriangleNormals::operator()(Vec3 point) const {
  const auto& [a, b, c] = corner_;
  const Vec3 n = cross(b - a, c - a);
  const float squared = dot(n, n);
  if (!(squared > 0)) return normal_[0];
  const float u = dot(cross(c - b, point - b), n) / squared;
  const float v = dot(cross(a - c, point - c), n) / squared;
  return normalized(normal_[0] * u + normal_[1] * v + normal_[2] * (1 - u - v));
}

}  // namespace powercell::io
