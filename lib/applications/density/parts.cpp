#include "lib/applications/density/parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/applications/density/geometric.hpp"
#include "lib/applications/density/simplex.hpp"
#include "lib/applications/density/simplex_rule.hpp"
#include "lib/base/sums.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

// Parts at first, of equal measure. Mass that none of their points shows is missed.
constexpr double parts_at_first = 1 << 15;
constexpr std::size_t most_parts = 1 << 19;  // 90 MB
// A part is steep if the least density evaluated in it is below this fraction of the largest. The edge of the
// support may then pass unseen between the points of its neighbours, so steep parts are divided until they
// hold little mass: their mass counts as waste this many times.
constexpr double steepest = 1e-6, steep_waste = 32;
constexpr int most_steep = 600;   // steep parts take long to integrate
constexpr double little = 1e-4;   // share of the mass below which a steep part does not count
constexpr int most_rounds = 500;  // each halves the parts with the most waste
// Sum of measure x most over the parts, relative to the mass: the expected number of draws for a point.
// Enough to stop, and too much to accept.
constexpr double enough = 4, too_much = 1000;

double measure_of(const Part& part) {
  const auto& c = part.corner;
  return part.corners == 3 ? measure_of_triangle(c[0], c[1], c[2])
                           : measure_of_tetrahedron(c[0], c[1], c[2], c[3]);
}

SimplexEdge longest_edge_of(const Part& part) {
  return longest_edge(part.corners, [&](std::size_t c) -> const Point& { return part.corner[c]; });
}

void set_size(Part& part) {
  part.longest = std::sqrt(longest_edge_of(part).square);
  part.measure = measure_of(part);
}

/// Bisects the longest edge; tetrahedra keep their orientation.
std::array<Part, 2> halves(const Part& part) {
  const SimplexEdge edge = longest_edge_of(part);
  std::array<Part, 2> half{part, part};
  for (std::size_t k = 0; k < 3; ++k)
    half[0].corner[edge.from][k] = half[1].corner[edge.to][k] =
        part.corner[edge.from][k] / 2 + part.corner[edge.to][k] / 2;
  for (Part& one : half) set_size(one);
  return half;
}

/// Triangulates the regions of a domain: polygons as fans from their first corner, solids from their middle.
std::vector<Part> simplices_of(const Domain& domain) {
  const RegionsView mesh = domain.regions();
  const Cells cells = region_cells(mesh);
  const DomainBox box(domain);
  std::vector<Part> parts;
  const auto add = [&](std::uint32_t region, std::size_t corners, const std::array<Point, 4>& corner) {
    Part part{region, corners, corner};
    set_size(part);
    if (part.measure < 0) {
      std::swap(part.corner[1], part.corner[2]);
      part.measure = -part.measure;
    }
    if (part.measure > 0) parts.push_back(part);
  };
  for (std::size_t r = 0; r < mesh.size(); ++r) {
    const Piece piece(cells, box, r);
    const std::uint64_t count = piece.vertex_count();
    for (std::uint64_t k = 2; k < count && !piece.solid(); ++k)
      add(piece.region(), 3, {piece.vertex(0), piece.vertex(k - 1), piece.vertex(k)});
    if (!piece.solid()) continue;
    Point middle{};
    for (std::uint64_t v = 0; v < count; ++v)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += piece.vertex(v)[k] / static_cast<double>(count);
    for (std::uint64_t f = piece.first_face(); f < piece.end_face(); ++f)
      for (std::uint64_t k = 2; k < piece.corner_count(f); ++k)
        add(piece.region(), 4,
            {middle, piece.vertex(piece.corner(f, 0)), piece.vertex(piece.corner(f, k - 1)),
             piece.vertex(piece.corner(f, k))});
  }
  return parts;
}

Cells cells_of(std::span<const Part> parts, int dimension) {
  std::vector<double> vertices;
  std::vector<std::uint32_t> offset{0}, source;
  for (const Part& part : parts) {
    for (std::size_t c = 0; c < part.corners; ++c)
      vertices.insert(vertices.end(), part.corner[c].begin(), part.corner[c].begin() + dimension);
    offset.push_back(offset.back() + static_cast<std::uint32_t>(part.corners));
    source.push_back(part.region);
  }
  std::vector<std::uint32_t> vertex(offset.back());
  std::iota(vertex.begin(), vertex.end(), 0);
  const std::vector<Border> facet(offset.back());  // one for each corner
  const bool solid = parts.front().corners == 4;
  Cells cells = region_cells({solid ? RegionShape::tetrahedron : RegionShape::polygon, dimension,
                              solid ? 3 : 2, vertices, offset, vertex, offset, facet, source, 0});
  cells.region = source;
  return cells;
}

class Division {
 public:
  Division(const Domain& domain, const DensityModel& density)
      : domain_(domain),
        density_(static_cast<const GeometricDensity&>(density)),
        source_(density.source(domain)),
        parts_(simplices_of(domain)) {
    divide([size = domain.measure() / parts_at_first](const Part& part) { return part.measure > size; });
  }

  std::vector<Part> run() {
    // What is negligible follows from a first, rough mass.
    measure(0, std::numeric_limits<double>::infinity());
    double mass = sum(&Part::mass);
    measure(0, mass);
    mass = sum(&Part::mass);
    if (!(mass > 0)) refuse_too_small_a_part("it is 0 at all points tried");
    double waste = sum(&Part::waste);
    for (int round = 0; round < most_rounds && parts_.size() < most_parts; ++round) {
      if (waste <= (enough - 1) * mass) break;
      const std::size_t first_new = split_where_wasted(waste / 2 / static_cast<double>(parts_.size()));
      measure(first_new, mass);
      mass = sum(&Part::mass);
      waste = sum(&Part::waste);
    }
    if (waste > too_much * mass) refuse_too_small_a_part("it varies too much even in the smallest parts");
    return std::move(parts_);
  }

 private:
  double sum(double Part::*value) const {
    CompensatedSum<long double> all;
    for (const Part& part : parts_) all.add(part.*value);
    return all.value();
  }

  /// Splits the parts for which `which(part)` holds, and their halves likewise, until there are none.
  template <class Which>
  void divide(const Which& which) {
    for (std::size_t from = 0; from < parts_.size();) from = split(which, from);
  }

  /// Splits the parts with more waste than `share`, and larger parts around the densest points of these: a
  /// density that grows towards a corner may be the flank of a peak that the neighbours contain but do not
  /// see.
  /// \return the index of the first new part
  std::size_t split_where_wasted(double share) {
    constexpr std::size_t most_spots = 64;  // those with the most waste
    std::vector<const Part*> spots;
    for (const Part& part : parts_)
      if (part.waste > share) spots.push_back(&part);
    const std::size_t kept = std::min(spots.size(), most_spots);
    std::partial_sort(spots.begin(), spots.begin() + static_cast<std::ptrdiff_t>(kept), spots.end(),
                      [](const Part* a, const Part* b) { return a->waste > b->waste; });
    std::vector<Part> dense;
    for (std::size_t k = 0; k < kept; ++k) dense.push_back(*spots[k]);
    return split(
        [&](const Part& part) {
          return part.waste > share || std::any_of(dense.begin(), dense.end(), [&](const Part& one) {
                   return part.longest > 2 * one.longest &&
                          measure_of_segment(part.corner[0], one.at_most) < 2 * part.longest;
                 });
        },
        0);
  }

  /// Replaces the parts from index `from` on for which `which(part)` holds by their halves, at the end.
  /// \return the index of the first half
  template <class Which>
  std::size_t split(const Which& which, std::size_t from) {
    const auto begin = parts_.begin() + static_cast<std::ptrdiff_t>(from);
    const auto chosen =
        std::stable_partition(begin, parts_.end(), [&](const Part& part) { return !which(part); });
    const std::vector<Part> divided(chosen, parts_.end());
    parts_.erase(chosen, parts_.end());
    const std::size_t first = parts_.size();
    for (const Part& part : divided)
      for (const Part& half : halves(part)) parts_.push_back(half);
    return first;
  }

  /// Computes mass and waste of the parts from index `first` on.
  /// \param mass  current estimate of the total mass
  void measure(std::size_t first, double mass) {
    constexpr double tolerance = 1e-2, negligible_share = 1e-3;
    const std::span<Part> fresh = std::span(parts_).subspan(first);
    const std::vector<double> masses =
        density_.masses(domain_, cells_of(fresh, domain_.dimension()),
                        {tolerance, negligible_share * mass / domain_.measure()}, thread_count(0));
    for (std::size_t k = 0; k < fresh.size(); ++k) {
      fresh[k].mass = std::max(masses[k], 0.0);
      set_waste(fresh[k], mass);
    }
  }

  void set_waste(Part& part, double mass) {
    // Mass that the points do not show counts as waste this many times: more than `enough`, so it gets
    // divided.
    constexpr double unseen = 8;
    const SimplexRules& rules = simplex_rules(static_cast<int>(part.corners) - 1);
    points_.assign(part.corner.begin(), part.corner.begin() + static_cast<std::ptrdiff_t>(part.corners));
    for (std::size_t q = 0; q < rules.size[2]; ++q) {
      Point x{};
      for (std::size_t c = 0; c < part.corners; ++c)
        for (std::size_t k = 0; k < 3; ++k) x[k] += rules.point[q][c] * part.corner[c][k];
      points_.push_back(x);
    }
    values_.resize(points_.size());
    source_->evaluate(points_, part.region, values_);
    const double mean =
        std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
    const auto most = std::max_element(values_.begin(), values_.end());
    part.at_most = points_[static_cast<std::size_t>(most - values_.begin())];
    part.most = std::max(*most, part.mass / part.measure);
    part.waste = part.measure * part.most - part.mass + unseen * std::abs(part.measure * mean - part.mass);
    if (density_.exact() || !(*std::min_element(values_.begin(), values_.end()) < steepest * *most)) return;
    part.waste += steep_waste * part.mass;
    steep_ += part.mass > little * mass ? 1 : 0;
    if (steep_ > most_steep) refuse_too_small_a_part("around that part it falls too steeply");
  }

  const Domain& domain_;
  const GeometricDensity& density_;
  std::unique_ptr<PointSource> source_;
  std::vector<Part> parts_;
  std::vector<Point> points_;
  std::vector<double> values_;
  int steep_ = 0;
};

}  // namespace

void refuse_too_small_a_part(const std::string& why) {
  throw Error(ErrorCode::invalid_argument,
              "the density is positive in too small a part of the domain for random points: " + why +
                  "; choose a smaller domain around that part, or give points to start from");
}

std::vector<Part> parts_by_density(const Domain& domain, const DensityModel& density) {
  return Division(domain, density).run();
}

}  // namespace powercell
