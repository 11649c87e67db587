#include <algorithm>
#include <cmath>

#include "lib/base/text.hpp"
#include "lib/base/threads.hpp"
#include "lib/domain/period.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

/// How far a point lies outside a piece, and how far rounding may put it there.
struct Outside {
  double distance = 0, allowed = 1;
  double ratio() const { return distance / allowed; }
};

/// Unit normal of a region of a surface; (0, 0, 1) in the plane.
Vector plane_normal(const RegionMesh& mesh, std::uint32_t region) {
  if (mesh.dimension == 2) return {0, 0, 1};
  const std::uint32_t* v = &mesh.region_vertex[mesh.region_offset[region]];
  const double* x = mesh.vertices.data();
  const Vector normal = cross(difference<long double>(x + 3 * v[1], x + 3 * v[0]),
                              difference<long double>(x + 3 * v[2], x + 3 * v[0]));
  return (1 / norm(normal)) * normal;
}

struct Face {
  Vector normal{};  // outward, unit; zero for a face without extent
  Vector middle{};
  double slant = 0;  // how much its direction turns, at most, per unit by which its corners move
};

Face face_of(const std::vector<Vector>& corners, const Vector& plane) {
  Face face;
  for (const Vector& x : corners)
    face.middle = face.middle + (1 / static_cast<long double>(corners.size())) * x;
  long double extent = 0;
  for (const Vector& x : corners) extent = std::max(extent, norm(x - face.middle));
  if (corners.size() == 2) {
    face.normal = cross(corners[1] - corners[0], plane);
  } else {
    face.normal = twice_area(corners);
  }
  const long double size = norm(face.normal);  // its length, or twice its area
  if (!(size > 0)) return {};
  face.normal = (1 / size) * face.normal;
  face.slant = static_cast<double>(corners.size() == 2 ? 2 / size : 2 * extent / size);
  return face;
}

class Owners {
 public:
  Owners(const RegionMesh& mesh, const Cells& cells, const Rounding& rounding)
      : mesh_(mesh),
        period_(mesh.period.get()),
        cells_(cells),
        rounding_(rounding),
        count_(cells.cell_count()) {}

  /// Tries all seeds. Of two at one position the heavier wins, also where its weight is lost in rounding
  /// beside the distance.
  std::size_t least_power(const Vector& x) const {
    std::size_t best = 0;
    long double least = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Vector y = x - image(i, x) - rounding_.position(i);
      const long double power = dot(y, y) - rounding_.weight(i);
      const bool heavier = rounding_.weight(i) > rounding_.weight(best);
      if (i == 0 || power < least ||
          (power == least && heavier && rounding_.position(i) == rounding_.position(best))) {
        least = power;
        best = i;
      }
    }
    return best;
  }

  /// The distance of a sample outside the cell of seed i.
  Outside outside_cell(const Sample& sample, std::size_t i) const {
    Outside best{1e300, 1};
    const Vector point = sample.point - image(i, sample.point);
    bool in_region = false;
    for (std::uint64_t p = cells_.cell_offset[i]; p < cells_.cell_offset[i + 1]; ++p) {
      if (cells_.region[p] != sample.region) continue;
      in_region = true;
      best = nearer(best, outside_piece(point, i, p));
    }
    // Pieces that are too flat are not kept; the point then lies next to a piece in a neighbouring region.
    for (std::uint64_t p = cells_.cell_offset[i]; !in_region && p < cells_.cell_offset[i + 1]; ++p)
      best = nearer(best, outside_piece(point, i, p));
    return best;
  }

  /// The best result over all seeds whose bisector with the owner passes within rounding of the point.
  Outside outside_ties(const Sample& sample, std::size_t owner, Outside best) const {
    const Vector p = rounding_.position(owner), moved = image(owner, sample.point);
    const Vector y = sample.point - moved - p;
    for (std::size_t j = 0; j < count_; ++j) {
      if (j == owner || rounding_.position(j) == p) continue;
      const Vector q = rounding_.position(j) - p + (image(j, sample.point) - moved);
      if (-rounding_.beyond(owner, j, y, q) > rounding_.wall_shift(owner, j, q)) continue;
      best = nearer(best, outside_cell(sample, j));
    }
    return best;
  }

 private:
  /// The vector of the lattice to the image of seed i that is nearest to the point; 0 unless the domain is
  /// periodic. In a reduced basis it is among those around the one of rounded coordinates.
  Vector image(std::size_t i, const Vector& x) const {
    if (!period_) return {};
    const Vector y = x - rounding_.position(i);
    const double at[3] = {static_cast<double>(y[0]), static_cast<double>(y[1]), static_cast<double>(y[2])},
                 zero[3] = {};
    const Period::Coordinates fraction = period_->fraction(at), origin = period_->fraction(zero);
    Vector middle{};
    int combinations = 1;
    for (int k = 0; k < period_->count(); ++k) {
      middle = middle + std::round(fraction[k] - origin[k]) * vector_of(k);
      combinations *= 3;
    }
    Vector best = middle;
    for (int c = 0; c < combinations; ++c) {
      Vector other = middle;
      for (int k = 0, rest = c; k < period_->count(); ++k, rest /= 3)
        other = other + static_cast<long double>(rest % 3 - 1) * vector_of(k);
      if (norm(y - other) < norm(y - best)) best = other;
    }
    return best;
  }
  Vector vector_of(int k) const {
    const Period::Coordinates& v = period_->vector(k);
    return {v[0], v[1], v[2]};
  }

  static Outside nearer(const Outside& a, const Outside& b) { return b.ratio() < a.ratio() ? b : a; }

  Outside outside_piece(const Vector& x, std::size_t i, std::uint64_t piece) const {
    const Vector plane = cells_.cell_dimension == 2 ? plane_normal(mesh_, cells_.region[piece]) : Vector{};
    Outside worst;
    for (std::uint64_t f = cells_.face_offset[piece]; f < cells_.face_offset[piece + 1]; ++f) {
      const Face face = face_of(face_corners(cells_, piece, f), plane);
      const double distance = static_cast<double>(dot(x - face.middle, face.normal));
      if (distance <= 0) continue;
      const double away = static_cast<double>(norm(x - face.middle));
      const Outside here{distance, rounding_.shift(i, cells_.border[f]) * (1 + away * face.slant)};
      if (here.ratio() > worst.ratio()) worst = here;
    }
    return worst;
  }

  const RegionMesh& mesh_;
  const Period* period_;  // null unless the domain is periodic
  const Cells& cells_;
  const Rounding& rounding_;
  std::size_t count_;
};

std::string describe(const Sample& sample, std::size_t owner, const Outside& outside, int dimension) {
  std::string point = digits(static_cast<double>(sample.point[0]));
  for (std::size_t k = 1; k < static_cast<std::size_t>(dimension); ++k)
    point += ", " + digits(static_cast<double>(sample.point[k]));
  const std::string where = outside.distance < 1e300
                                ? "lies " + digits(outside.distance, 3) + " outside its cell"
                                : "has no cell to lie in";
  return "the point (" + point + ") of region " + std::to_string(sample.region) + " belongs to seed " +
         std::to_string(owner) + " but " + where;
}

}  // namespace

LawCheck check_owners(const std::vector<Sample>& samples, const RegionMesh& mesh, const Cells& cells,
                      const Rounding& rounding) {
  const Owners owners(mesh, cells, rounding);
  std::vector<Worst> worst(samples.size());
  parallel_for(thread_count(0), samples.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const std::size_t owner = owners.least_power(samples[s].point);
      Outside outside = owners.outside_cell(samples[s], owner);
      if (outside.ratio() > 1) outside = owners.outside_ties(samples[s], owner, outside);
      worst[s].see(outside.distance, outside.allowed,
                   [&] { return describe(samples[s], owner, outside, cells.dimension); });
    }
  });
  Worst all;
  for (const Worst& one : worst) all.see(one);
  return all.result("ownership: random points lie in the cell of least power",
                    rounding.unit() * rounding.diagonal());
}

}  // namespace powercell
