#include "lib/applications/density/constant.hpp"

#include <algorithm>

namespace powercell {
namespace {

struct ConstantSource : PointSource {
  double value;
  explicit ConstantSource(double v) : value(v) {}
  void evaluate(std::span<const Point>, std::uint32_t, std::span<double> values) override {
    std::fill(values.begin(), values.end(), value);
  }
};

}  // namespace

std::unique_ptr<PointSource> ConstantDensity::source(const Domain&) const {
  return std::make_unique<ConstantSource>(value_);
}

double ConstantDensity::total(const Domain& domain, int) const {
  return value_ * domain.measure();
}

DensityIntegrals ConstantDensity::integrate(Diagram& diagram, const IntegrationOptions& options) const {
  diagram.compute(options.walls, false);
  const Measures& measures = diagram.measures();
  DensityIntegrals result;
  result.dimension = measures.dimension;
  result.mass = measures.mass;
  result.centroid = measures.centroid;
  result.second_moment = measures.second_moment;
  result.status = measures.status;
  if (options.walls) result.walls = diagram.adjacency();
  if (value_ != 1) {
    for (double& m : result.mass) m *= value_;
    for (double& s : result.second_moment) s *= value_;
    for (double& a : result.walls.wall) a *= value_;
    result.walls.asymmetry *= value_;
  }
  return result;
}

}  // namespace powercell
