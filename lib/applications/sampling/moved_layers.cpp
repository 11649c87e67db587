#include "lib/applications/sampling/moved_layers.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/regions.hpp>

#include "lib/applications/density/pointwise.hpp"

namespace powercell {
namespace {

/// Where the points of a region of the moved surface come from.
struct Origin {
  std::uint32_t region;  // of the surface
  double shift;          // along the axis
};

class MovedSource : public PointSource {
 public:
  MovedSource(std::unique_ptr<PointSource> source, const std::vector<Origin>& origin, std::size_t axis)
      : source_(std::move(source)), origin_(origin), axis_(axis) {}
  void evaluate(std::span<const Point> x, std::uint32_t region, std::span<double> values) override {
    back_.assign(x.begin(), x.end());
    for (Point& point : back_) point[axis_] -= origin_[region].shift;
    source_->evaluate(back_, origin_[region].region, values);
  }

 private:
  std::unique_ptr<PointSource> source_;
  const std::vector<Origin>& origin_;
  std::size_t axis_;
  std::vector<Point> back_;
};

class MovedDensity : public PointwiseDensity {
 public:
  MovedDensity(Density density, Domain surface, std::vector<Origin> origin, std::size_t axis)
      : PointwiseDensity(tolerance),
        density_(std::move(density)),
        surface_(std::move(surface)),
        origin_(std::move(origin)),
        axis_(axis) {}
  std::unique_ptr<PointSource> source(const Domain&) const override {
    return std::make_unique<MovedSource>(density_.model().source(surface_), origin_, axis_);
  }

 private:
  // Points move by masses that are right to some per cent; those of the result are of the density itself.
  static constexpr double tolerance = 1e-6;
  Density density_;
  Domain surface_;
  std::vector<Origin> origin_;
  std::size_t axis_;
};

std::size_t thinnest_axis(const Domain& surface) {
  const std::array<double, 3> low = surface.low(), high = surface.high();
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] < high[axis] - low[axis]) axis = k;
  return axis;
}

Domain moved(const RegionsView& mesh, const std::vector<std::uint32_t>& layer, std::size_t axis,
             double pitch) {
  std::vector<double> vertices;
  vertices.reserve(9 * mesh.size());
  for (std::size_t r = 0; r < mesh.size(); ++r)
    for (std::uint32_t k = mesh.region_offset[r]; k < mesh.region_offset[r + 1]; ++k) {
      const double* x = &mesh.vertices[3 * std::size_t{mesh.region_vertex[k]}];
      vertices.insert(vertices.end(), x, x + 3);
      vertices[vertices.size() - 3 + axis] += layer[r] * pitch;
    }
  std::vector<std::uint32_t> triangles(3 * mesh.size());
  std::iota(triangles.begin(), triangles.end(), 0U);
  return Domain::surface(vertices, triangles);
}

}  // namespace

MovedLayers::MovedLayers(const Domain& surface, const Layers& layers, double gap)
    : surface_(surface),
      axis_(thinnest_axis(surface)),
      pitch_(surface.high()[axis_] - surface.low()[axis_] + gap),
      count_(layers.count),
      layer_(layers.of_region),
      moved_(moved(surface.regions(), layer_, axis_, pitch_)) {}

Density MovedLayers::density(const Density& of_surface) const {
  if (of_surface.is_constant()) return of_surface;
  std::vector<Origin> origin;
  for (const std::uint32_t region : moved_.regions().source)
    origin.push_back({region, layer_[region] * pitch_});
  return Density(std::make_shared<MovedDensity>(of_surface, surface_, std::move(origin), axis_));
}

std::vector<std::size_t> MovedLayers::move_back(std::vector<double>& positions) const {
  std::vector<std::size_t> points(count_);
  // Layers are separated halfway between the box of one and that of the next.
  const double middle = (surface_.low()[axis_] + surface_.high()[axis_]) / 2;
  for (std::size_t k = axis_; k < positions.size(); k += 3) {
    const double layer = std::clamp(std::round((positions[k] - middle) / pitch_), 0.0, count_ - 1.0);
    positions[k] -= layer * pitch_;
    ++points[static_cast<std::size_t>(layer)];
  }
  return points;
}

}  // namespace powercell
