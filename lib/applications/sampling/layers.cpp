#include "lib/applications/sampling/layers.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "lib/applications/density/model.hpp"
#include "lib/applications/sampling/near_sides.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

using Vec = Vector3<double>;

// Sides nearer than this, in units of the spacing, share cells: measured on plates, whose sides share 18 % of
// the area at 0.5 and 0.3 % at 0.75.
constexpr double near = 0.7;
// Of `near`, for densities that are not constant: the probes of the surface are uniform.
constexpr double least_radius = 0.5, largest_radius = 4;
constexpr double negligible = 0.01;         // of the mass
constexpr std::size_t first_probes = 2048;  // to see whether sides are near to each other at all
// Any place is in the balls of some twenty. Fewer do where triangles are larger than balls.
constexpr std::size_t probes_a_point = 12, most_probes = 4'000'000;
// Layers grow around an edge of 90° after the regions within this many spacings.
constexpr double edge_cost = 10;
// Fewer points on a layer are not spread over it.
constexpr double least_points = 16;

struct Probes {
  std::vector<NearSides> found;  ///< those with opposite sides
  double share = 0;              ///< of the mass at which there are any
};

Probes probe(const Domain& surface, const Density& density, const NearSidesSearch& search, double spacing,
             std::size_t count, std::uint64_t random_seed, int threads) {
  const std::vector<RegionPoint> points = random_points(surface, count, random_seed);
  const double mean = density.total(surface, threads) / surface.measure();
  std::vector<NearSides> sides(count);
  std::vector<double> value(count, mean);
  parallel_for(threads_for(count, threads, 256), count, [&](std::size_t begin, std::size_t end) {
    const std::unique_ptr<PointSource> source =
        density.is_constant() ? nullptr : density.model().source(surface);
    NearSidesSearch own = search;
    for (std::size_t k = begin; k < end; ++k) {
      if (source) source->evaluate({&points[k].point, 1}, points[k].region, {&value[k], 1});
      if (!(value[k] > 0)) continue;
      const double size = std::clamp(std::sqrt(mean / value[k]), least_radius, largest_radius);
      sides[k] = own.around(points[k], near * spacing * size);
    }
  });
  Probes result;
  double mass = 0, sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    sum += value[k];
    if (sides[k].opposite.empty()) continue;
    mass += value[k];
    result.found.push_back(std::move(sides[k]));
  }
  result.share = sum > 0 ? mass / sum : 0;
  return result;
}

/// Assigns regions to layers: of each probe a layer may have the own or the opposite regions, not both.
class Growth {
 public:
  Growth(const Domain& surface, const std::vector<NearSides>& probes, double spacing)
      : mesh_(surface.regions()),
        probes_(probes),
        edge_length_(edge_cost * spacing),
        layer_(mesh_.size(), unassigned),
        offset_(mesh_.size() + 1) {
    for_each_membership([&](std::uint32_t r, std::uint32_t, Side) { ++offset_[r + 1]; });
    for (std::size_t r = 0; r < mesh_.size(); ++r) offset_[r + 1] += offset_[r];
    memberships_.resize(offset_.back());
    std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
    for_each_membership([&](std::uint32_t r, std::uint32_t probe, Side side) {
      memberships_[next[r]++] = {probe, side};
    });
    for (std::uint32_t r = 0; r < mesh_.size(); ++r) middle_.push_back(middle_of(r));
  }

  /// \param least  area of a layer; what is left in layers below goes to those next to it
  Layers run(double least) {
    std::uint32_t count = 0, start = probes_.front().own.front();
    do {
      taken_.assign(probes_.size(), Side::none);
      double area = grow(start, count);
      for (std::uint32_t r = 0; r < mesh_.size(); ++r)
        if (layer_[r] == unassigned) area += grow(r, count);
      if (area >= least)
        ++count;
      else
        std::ranges::replace(layer_, count, rest);
      start = next_start();
    } while (start < mesh_.size());
    distribute_rest();
    return {count, std::move(layer_)};
  }

 private:
  static constexpr std::uint32_t unassigned = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t rest = unassigned - 1;
  enum class Side : std::uint8_t { none, own, opposite };
  struct Membership {
    std::uint32_t probe;
    Side side;
  };

  template <class Each>
  void for_each_membership(const Each& each) const {
    for (std::uint32_t k = 0; k < probes_.size(); ++k) {
      for (const std::uint32_t r : probes_[k].own) each(r, k, Side::own);
      for (const std::uint32_t r : probes_[k].opposite) each(r, k, Side::opposite);
    }
  }

  std::span<const Membership> memberships(std::uint32_t r) const {
    return std::span(memberships_).subspan(offset_[r], offset_[r + 1] - offset_[r]);
  }

  struct Middle {
    Vec at, normal;
    double area;
  };
  Middle middle_of(std::uint32_t r) const {
    const auto corner = [&](std::uint32_t k) {
      const double* x = &mesh_.vertices[3 * std::size_t{mesh_.region_vertex[mesh_.region_offset[r] + k]}];
      return Vec{x[0], x[1], x[2]};
    };
    const Vec a = corner(0), b = corner(1), c = corner(2), n = cross(b - a, c - a);
    return {(1.0 / 3) * (a + b + c), (1 / norm(n)) * n, norm(n) / 2};
  }

  /// The unassigned region with the most probes.
  std::uint32_t next_start() const {
    auto best = static_cast<std::uint32_t>(mesh_.size());
    for (std::uint32_t r = 0; r < mesh_.size(); ++r)
      if (layer_[r] == unassigned &&
          (best == mesh_.size() || memberships(r).size() > memberships(best).size()))
        best = r;
    return best;
  }

  bool fits(std::uint32_t r) const {
    return std::ranges::all_of(memberships(r), [&](const Membership& m) {
      return taken_[m.probe] == Side::none || taken_[m.probe] == m.side;
    });
  }

  /// Adds the region and those connected with it, the nearest first, as far as they fit.
  /// \return their area
  double grow(std::uint32_t start, std::uint32_t layer) {
    using Reached = std::pair<double, std::uint32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
    queue.push({0, start});
    double area = 0;
    while (!queue.empty()) {
      const auto [length, r] = queue.top();
      queue.pop();
      if (layer_[r] != unassigned || !fits(r)) continue;
      layer_[r] = layer;
      area += middle_[r].area;
      for (const Membership& m : memberships(r)) taken_[m.probe] = m.side;
      for (std::uint32_t f = mesh_.facet_offset[r]; f < mesh_.facet_offset[r + 1]; ++f) {
        const Border& border = mesh_.facet[f];
        if (border.kind != Border::Kind::interior || layer_[border.index] != unassigned) continue;
        const Middle &from = middle_[r], &to = middle_[border.index];
        const double bend = 1 - dot(from.normal, to.normal);
        queue.push({length + norm(to.at - from.at) + edge_length_ * bend, border.index});
      }
    }
    return area;
  }

  /// Gives the regions of small layers to layers next to them, and those next to none to the first.
  void distribute_rest() {
    std::vector<std::uint32_t> front;
    for (std::uint32_t r = 0; r < mesh_.size(); ++r)
      if (layer_[r] != rest) front.push_back(r);
    for (std::size_t k = 0; k < front.size(); ++k)
      for (std::uint32_t f = mesh_.facet_offset[front[k]]; f < mesh_.facet_offset[front[k] + 1]; ++f) {
        const Border& border = mesh_.facet[f];
        if (border.kind != Border::Kind::interior || layer_[border.index] != rest) continue;
        layer_[border.index] = layer_[front[k]];
        front.push_back(border.index);
      }
    std::ranges::replace(layer_, rest, 0U);
  }

  RegionsView mesh_;
  const std::vector<NearSides>& probes_;
  double edge_length_;
  std::vector<std::uint32_t> layer_;     // per region
  std::vector<std::size_t> offset_;      // per region, into the next
  std::vector<Membership> memberships_;  // of regions in probes
  std::vector<Middle> middle_;           // per region
  std::vector<Side> taken_;              // per probe: the side that the layer has
};

}  // namespace

Layers find_layers(const Domain& surface, const Density& density, std::size_t n, std::uint64_t random_seed,
                   int threads) {
  if (static_cast<double>(n) < 2 * least_points) return {};
  threads = thread_count(threads);
  const double spacing = std::sqrt(surface.measure() / static_cast<double>(n));
  const NearSidesSearch search(surface);
  const auto probe_with = [&](std::size_t count) {
    return probe(surface, density, search, spacing, count, random_seed, threads);
  };
  Probes probes = probe_with(first_probes);
  if (!(probes.share > negligible)) return {};
  const std::size_t count = std::min(probes_a_point * std::min(n, surface.region_count()), most_probes);
  if (count > first_probes) probes = probe_with(count);
  if (probes.found.empty()) return {};
  Layers layers = Growth(surface, probes.found, spacing).run(least_points * spacing * spacing);
  return layers.count > 1 ? layers : Layers{};
}

}  // namespace powercell
