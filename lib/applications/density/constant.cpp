#include <algorithm>
#include <powercell/error.hpp>

#include "lib/applications/density/model.hpp"
#include "lib/base/text.hpp"

namespace powercell {
namespace {

struct ConstantSource : PointSource {
  double value;
  explicit ConstantSource(double v) : value(v) {}
  void evaluate(std::span<const Point>, std::uint32_t, std::span<double> values) override {
    std::fill(values.begin(), values.end(), value);
  }
};

/// Multiplies measures and walls by a number; no cell geometry is needed.
class ConstantDensity : public DensityModel {
 public:
  explicit ConstantDensity(double value) : value_(value) {}

  double total(const Domain& domain, int) const override { return value_ * domain.measure(); }

  DensityIntegrals integrate(Diagram& diagram, const IntegrationOptions& options) const override {
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

  std::unique_ptr<PointSource> source(const Domain&) const override {
    return std::make_unique<ConstantSource>(value_);
  }
  bool is_constant() const override { return true; }

 private:
  double value_;
};

}  // namespace

DensityModelPtr make_constant(double value) {
  if (!(value > 0 && value <= Density::largest_value))
    throw Error(ErrorCode::invalid_argument, "a constant density must be positive and at most " +
                                                 digits(Density::largest_value) + ", got " + digits(value));
  return std::make_shared<ConstantDensity>(value);
}

}  // namespace powercell
