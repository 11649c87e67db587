#include "lib/update/centers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/base/threads.hpp"
#include "lib/base/vectors.hpp"

namespace powercell {
namespace {

using Point = Vector3<double>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double least_product = 1e-260;  // of products that did not underflow
constexpr std::size_t shared_simplices = 4096;

double size_of(const Point& a) {
  return std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
}

Point relative(const Site& a, const Site& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// The equation r.c = h / 2 of a corner at r.
struct Equation {
  Point r;
  double h, h_size;
  Equation(const Site& corner, const Site& origin) : r(relative(corner, origin)) {
    const double square = dot(r, r), weights = origin[3] - corner[3];
    h = square + weights;
    h_size = square + std::fabs(weights);
  }
};

/// Of a simplex, relative to its first corner.
struct RelativeCenter {
  Point at;
  double error;
  int orientation;  ///< of the simplex, or 0 if that is not certain

  Center absolute(const Site& origin) const {
    Center center{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double sum = origin[k] + at[k], part = sum - origin[k];
      center.at[k] = sum;
      center.rest[k] = static_cast<float>((origin[k] - (sum - part)) + (at[k] - part));
    }
    center.error = static_cast<float>(1.001 * error);
    return center;
  }
};

/// With m the largest coordinate of the edges and H the largest size of a right side, determinants have
/// parts of at most 6 m^3 (2 m^2 in the plane) and numerators of 9 m^2 H (4 m H), each with some ten
/// roundings.
RelativeCenter with_error(const Point& sum, double determinant, double m, double power, double h) {
  const double scale = 0.5 / determinant;
  RelativeCenter center{scale * sum, 0, 0};
  center.error = 64 * epsilon * (2 * power * h + power * m * size_of(center.at)) / std::fabs(determinant);
  if (!(center.error >= 0)) center.error = std::numeric_limits<double>::infinity();
  return center;
}

int certain_sign(double determinant, double size) {
  if (!(size > least_product) || !(std::fabs(determinant) > 32 * epsilon * size)) return 0;
  return determinant > 0 ? 1 : -1;
}

template <int D>
RelativeCenter relative_center(const DualMesh<D>& mesh, std::uint32_t s) {
  const auto& corner = mesh.simplex(s).corner;
  const std::span<const Site> sites = mesh.sites();
  const Site& origin = sites[corner[0]];
  const Equation a(sites[corner[1]], origin), b(sites[corner[2]], origin);
  if constexpr (D == 2) {
    const double m = std::max(size_of(a.r), size_of(b.r)), determinant = a.r[0] * b.r[1] - a.r[1] * b.r[0];
    const Point sum{a.h * b.r[1] - b.h * a.r[1], b.h * a.r[0] - a.h * b.r[0], 0};
    RelativeCenter center = with_error(sum, determinant, m, m, std::max(a.h_size, b.h_size));
    center.orientation = certain_sign(determinant, 2 * m * m);
    return center;
  } else {
    const Equation c(sites[corner[3]], origin);
    const Point bc = cross(b.r, c.r), ca = cross(c.r, a.r), ab = cross(a.r, b.r);
    const double determinant = dot(a.r, bc), m = std::max({size_of(a.r), size_of(b.r), size_of(c.r)});
    const Point sum = a.h * bc + (b.h * ca + c.h * ab);
    RelativeCenter center =
        with_error(sum, determinant, m, 6 * m * m, std::max({a.h_size, b.h_size, c.h_size}));
    center.orientation = certain_sign(determinant, 6 * m * m * m);
    return center;
  }
}

/// Finds what is broken in a range of simplices.
template <int D>
class Finder {
 public:
  Finder(const DualMesh<D>& mesh, bool moved, std::vector<Center>& centers)
      : mesh_(mesh), moved_(moved), centers_(centers) {}

  Broken run(std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t s = begin; s < end; ++s) {
      if (mesh_.is_removed(s)) continue;
      const RelativeCenter center = relative_center(mesh_, s);
      centers_[s] = center.absolute(mesh_.sites()[mesh_.simplex(s).corner[0]]);
      if (const int sign = center.orientation;
          moved_ && sign <= 0 && (sign < 0 || mesh_.orientation_of(mesh_.simplex(s).corner) <= 0)) {
        found_.inverted.push_back(s);
        continue;
      }
      check_facets(s, center);
    }
    return std::move(found_);
  }

 private:
  /// Each facet between two simplices is checked from the lower one.
  void check_facets(std::uint32_t s, const RelativeCenter& center) {
    const auto& simplex = mesh_.simplex(s);
    const Site& origin = mesh_.sites()[simplex.corner[0]];
    for (std::size_t k = 0; k < mesh_.corners; ++k) {
      const std::uint32_t f = simplex.across[k];
      if (f == mesh_.outside || f / 4 < s) continue;
      const std::uint32_t site = mesh_.opposite(f);
      const Equation e(mesh_.sites()[site], origin);
      const double level = e.h - 2 * dot(e.r, center.at),
                   size = std::fabs(e.r[0]) + std::fabs(e.r[1]) + std::fabs(e.r[2]),
                   error = 2 * size * center.error + 8 * epsilon * (e.h_size + size * size_of(center.at));
      if (level > error) continue;
      if (level < -error || is_broken(s, site)) found_.facets.push_back(mesh_.facet(s, k));
    }
  }

  bool is_broken(std::uint32_t s, std::uint32_t site) const {
    const int sign = mesh_.conflict(s, site);
    if (sign == 0) throw MeshUnusable();
    return sign > 0;
  }

  const DualMesh<D>& mesh_;
  bool moved_;
  std::vector<Center>& centers_;
  Broken found_;
};

void append(std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

template <int D>
Center center_of(const DualMesh<D>& mesh, std::uint32_t s) {
  return relative_center(mesh, s).absolute(mesh.sites()[mesh.simplex(s).corner[0]]);
}

template <int D>
Broken find_broken(const DualMesh<D>& mesh, bool moved, int threads, std::vector<Center>& centers) {
  const std::size_t count = mesh.simplex_count();
  centers.resize(count);
  const int workers = threads_for(count, threads, shared_simplices);
  std::vector<Broken> parts(static_cast<std::size_t>(workers));
  parallel_for(workers, parts.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      parts[p] = Finder<D>(mesh, moved, centers)
                     .run(static_cast<std::uint32_t>(count * p / parts.size()),
                          static_cast<std::uint32_t>(count * (p + 1) / parts.size()));
  });
  Broken all = std::move(parts.front());
  for (std::size_t p = 1; p < parts.size(); ++p) {
    append(all.facets, parts[p].facets);
    append(all.inverted, parts[p].inverted);
  }
  return all;
}

template Center center_of(const DualMesh<2>&, std::uint32_t);
template Center center_of(const DualMesh<3>&, std::uint32_t);
template Broken find_broken(const DualMesh<2>&, bool, int, std::vector<Center>&);
template Broken find_broken(const DualMesh<3>&, bool, int, std::vector<Center>&);

}  // namespace powercell
