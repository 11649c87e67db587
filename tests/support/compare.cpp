#include "tests/support/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace powercell::test {

namespace {

/// The c of Tolerances: a few tens of roundings in the scalar products and interpolation of a cut.
constexpr double roundings = 64;
/// The rim, in units of the seeds' spacing, of a wall that the reference does not have.
constexpr double unseen_rim = 100;

template <class... Args>
std::string text(const char* format, Args... args) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, args...);
  return buffer;
}

double coordinate_of(const SeedsView& seeds, std::size_t i, int k) {
  return k < seeds.dimension
             ? seeds.positions[i * static_cast<std::size_t>(seeds.dimension) + static_cast<std::size_t>(k)]
             : 0.0;
}

double weight_of(const SeedsView& seeds, std::size_t i) {
  return seeds.weights.empty() ? 0.0 : seeds.weights[i];
}

double distance(const SeedsView& seeds, std::size_t i, std::size_t j) {
  double sum = 0;
  for (int k = 0; k < seeds.dimension; ++k) {
    const double d = coordinate_of(seeds, i, k) - coordinate_of(seeds, j, k);
    sum += d * d;
  }
  return std::sqrt(sum);
}

/// Distance from seed i to the farthest corner of the domain's box.
double reach_of(const RegionMesh& mesh, const SeedsView& seeds, std::size_t i) {
  double sum = 0;
  for (int k = 0; k < mesh.dimension; ++k) {
    const double x = coordinate_of(seeds, i, k);
    const double d = std::max(std::abs(x - mesh.low[static_cast<std::size_t>(k)]),
                              std::abs(x - mesh.high[static_cast<std::size_t>(k)]));
    sum += d * d;
  }
  return std::sqrt(sum);
}

}  // namespace

Tolerances::Tolerances(double roundoff, const RegionMesh& mesh, const SeedsView& seeds,
                       const ReferenceDiagram& reference) {
  const std::size_t n = seeds.size();
  for (std::size_t i = 0; i < n; ++i) reach_.push_back(reach_of(mesh, seeds, i));
  std::vector<double> offset(n, 0.0);
  for (const auto& [pair, measure] : reference.wall) {
    const double q = distance(seeds, pair.first, pair.second);
    const double gap = std::abs(weight_of(seeds, pair.first) - weight_of(seeds, pair.second));
    offset[pair.first] = std::max(offset[pair.first], q + gap / q);
  }
  for (const auto& [pair, rim] : reference.rim) {
    double& both = rim_[std::minmax(pair.first, pair.second)];
    both = std::max(both, static_cast<double>(rim));
  }
  const double h = n ? spacing(mesh.measure, n, mesh.cell_dimension) : 1;
  extent_ = mesh.cell_dimension == 3 ? h : 1;
  const double floor = mesh.cell_dimension == 3 ? h * h : h;
  for (std::size_t i = 0; i < n; ++i) {
    shift_.push_back(roundings * roundoff * (reach_[i] + offset[i]));
    mass_.push_back(shift_[i] * std::max(static_cast<double>(reference.surface[i]), floor));
    may_vanish_.push_back(reference.mass[i] > 0 && reference.mass[i] <= static_cast<Real>(mass_[i]));
  }
  for (std::size_t k = 0; k < 3; ++k)
    coordinate_ = std::max({coordinate_, std::abs(mesh.low[k]), std::abs(mesh.high[k])});
  coordinate_ *= 4 * 0x1.0p-53;  // results are doubles in either precision
}

double Tolerances::wall(std::size_t i, std::size_t j) const {
  if (may_vanish_[i] || may_vanish_[j]) return std::numeric_limits<double>::infinity();
  const auto pair = std::minmax({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
  const auto found = rim_.find(pair);
  return std::max(shift_[i], shift_[j]) *
         std::max(found == rim_.end() ? 0 : found->second, unseen_rim * extent_);
}

namespace {

void compare_moments(Differences& out, std::size_t i, const Measures& measures,
                     const ReferenceDiagram& reference, const SeedsView& seeds,
                     const Tolerances& tolerances) {
  const double reach = tolerances.reach(i), mass = measures.mass[i];
  const double second = static_cast<double>(reference.second_moment[i]);
  if (!(std::abs(measures.second_moment[i] - second) <= tolerances.mass(i) * reach * reach))
    out.push_back(
        text("seed %zu: second moment %.17g, reference %.17g", i, measures.second_moment[i], second));
  const Real first[3] = {reference.first[i].x, reference.first[i].y, reference.first[i].z};
  for (int k = 0; k < seeds.dimension; ++k) {
    const double centroid =
        measures.centroid[i * static_cast<std::size_t>(seeds.dimension) + static_cast<std::size_t>(k)];
    const double defect =
        std::abs(mass * (centroid - coordinate_of(seeds, i, k)) - static_cast<double>(first[k]));
    if (!(defect <= tolerances.mass(i) * reach + mass * tolerances.coordinate()))
      out.push_back(text("seed %zu: centroid[%d] = %.17g is off by %.3g", i, k, centroid, defect / mass));
  }
}

void compare_empty(Differences& out, std::size_t i, const Measures& measures) {
  if (measures.mass[i] != 0 || measures.second_moment[i] != 0)
    out.push_back(text("seed %zu: empty, but mass %.17g and second moment %.17g", i, measures.mass[i],
                       measures.second_moment[i]));
  for (int k = 0; k < measures.dimension; ++k)
    if (!std::isnan(measures.centroid[i * static_cast<std::size_t>(measures.dimension) +
                                      static_cast<std::size_t>(k)]))
      out.push_back(text("seed %zu: empty, but its centroid is a number", i));
}

}  // namespace

Differences compare_measures(const Measures& measures, const ReferenceDiagram& reference,
                             const SeedsView& seeds, const Tolerances& tolerances) {
  Differences out;
  const std::size_t n = seeds.size(), d = static_cast<std::size_t>(seeds.dimension);
  if (measures.mass.size() != n || measures.centroid.size() != n * d || measures.second_moment.size() != n ||
      measures.status.size() != n || measures.dimension != seeds.dimension)
    return {text("sizes of the measures do not fit %zu seeds", n)};
  for (std::size_t i = 0; i < n; ++i) {
    const double expected = static_cast<double>(reference.mass[i]);
    const SeedStatus status = measures.status[i];
    if ((status == SeedStatus::duplicate) != (reference.status[i] == SeedStatus::duplicate))
      out.push_back(text("seed %zu: status %d, reference %d", i, static_cast<int>(status),
                         static_cast<int>(reference.status[i])));
    if ((status == SeedStatus::ok) != (measures.mass[i] > 0))
      out.push_back(
          text("seed %zu: status %d does not fit mass %.17g", i, static_cast<int>(status), measures.mass[i]));
    if (!(std::abs(measures.mass[i] - expected) <= tolerances.mass(i)))
      out.push_back(text("seed %zu: mass %.17g, reference %.17g, tolerance %.3g", i, measures.mass[i],
                         expected, tolerances.mass(i)));
    if (status == SeedStatus::ok)
      compare_moments(out, i, measures, reference, seeds, tolerances);
    else
      compare_empty(out, i, measures);
  }
  return out;
}

Differences check_symmetric(const Adjacency& adjacency) {
  Differences out;
  if (adjacency.offset.empty()) return {"adjacency without offsets"};
  if (adjacency.offset.back() != adjacency.neighbor.size() ||
      adjacency.wall.size() != adjacency.neighbor.size())
    return {"sizes of the adjacency do not fit"};
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> walls;
  for (std::uint32_t i = 0; i + 1 < adjacency.offset.size(); ++i)
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k) {
      const std::uint32_t j = adjacency.neighbor[k];
      if (j == i) out.push_back(text("seed %u is its own neighbour", i));
      if (k > adjacency.offset[i] && adjacency.neighbor[k - 1] >= j)
        out.push_back(text("row %u does not ascend", i));
      walls[{i, j}] = adjacency.wall[k];
    }
  for (const auto& [pair, measure] : walls) {
    const auto back = walls.find({pair.second, pair.first});
    if (back == walls.end())
      out.push_back(text("%u is in row %u but not the other way", pair.second, pair.first));
    else if (back->second != measure)
      out.push_back(text("wall %u-%u: %.17g from one side, %.17g from the other", pair.first, pair.second,
                         measure, back->second));
  }
  return out;
}

Differences compare_walls(const Adjacency& adjacency, const ReferenceDiagram& reference,
                          const Tolerances& tolerances, std::size_t* optional) {
  Differences out = check_symmetric(adjacency);
  if (adjacency.offset.size() != reference.mass.size() + 1) return {"adjacency has the wrong number of rows"};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<double, double>> walls;  // computed, reference
  for (const auto& [pair, measure] : reference.wall) walls[pair].second = static_cast<double>(measure);
  for (std::uint32_t i = 0; i + 1 < adjacency.offset.size(); ++i)
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k)
      walls[{i, adjacency.neighbor[k]}].first = adjacency.wall[k];
  std::size_t one_sided = 0;
  for (const auto& [pair, both] : walls) {
    if (both.first == 0 || both.second == 0) ++one_sided;
    if (!(std::abs(both.first - both.second) <= tolerances.wall(pair.first, pair.second)))
      out.push_back(text("wall %u-%u: %.17g, reference %.17g, tolerance %.3g", pair.first, pair.second,
                         both.first, both.second, tolerances.wall(pair.first, pair.second)));
  }
  if (optional) *optional = one_sided;
  return out;
}

namespace {

/// Positive for a positively oriented simplex of seeds.
double orientation(const std::uint32_t* corner, int corners, const SeedsView& seeds) {
  Vec e[3];
  for (int k = 1; k < corners; ++k) {
    const auto difference = [&](int c) {
      return static_cast<Real>(coordinate_of(seeds, corner[k], c)) - coordinate_of(seeds, corner[0], c);
    };
    e[k - 1] = {difference(0), difference(1), difference(2)};
  }
  return static_cast<double>(corners == 3 ? cross(e[0], e[1]).z : dot(e[0], cross(e[1], e[2])));
}

}  // namespace

Differences compare_dual(const Dual& dual, const ReferenceDiagram& reference, const SeedsView& seeds,
                         DomainKind kind, std::size_t uncertain) {
  Differences out;
  const int corners = kind == DomainKind::volume ? 4 : 3;
  if (dual.corners != corners) return {text("the dual has %d corners a simplex", dual.corners)};
  std::set<std::array<std::uint32_t, 4>> found;
  for (std::size_t s = 0; s < dual.size(); ++s) {
    const std::uint32_t* row = &dual.simplices[s * static_cast<std::size_t>(corners)];
    std::array<std::uint32_t, 4> key{row[0], row[1], row[2], row[corners - 1]};
    std::sort(key.begin(), key.begin() + corners);
    key[3] = key[static_cast<std::size_t>(corners) - 1];
    found.insert(key);
    // On a surface the orientation is that of a triangle of the domain, not of the seeds.
    if (kind != DomainKind::surface && !(orientation(row, corners, seeds) > 0))
      out.push_back(text("simplex %zu is not positively oriented", s));
    if (s > 0 && std::lexicographical_compare(row, row + corners, row - corners, row))
      out.push_back(text("simplex %zu is out of order", s));
  }
  std::vector<std::array<std::uint32_t, 4>> one_side;
  std::set_symmetric_difference(found.begin(), found.end(), reference.simplices.begin(),
                                reference.simplices.end(), std::back_inserter(one_side));
  if (one_side.size() > uncertain)
    for (const auto& s : one_side)
      out.push_back(
          text("simplex %u %u %u %u: %s", s[0], s[1], s[2], s[3], found.count(s) ? "extra" : "missing"));
  return out;
}

std::string summary(const Differences& differences) {
  std::string all = std::to_string(differences.size()) + " differences";
  for (std::size_t k = 0; k < std::min<std::size_t>(differences.size(), 8); ++k)
    all += "\n  " + differences[k];
  return all;
}

}  // namespace powercell::test
