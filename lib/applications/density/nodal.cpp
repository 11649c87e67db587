#include <powercell/regions.hpp>
#include <vector>

#include "lib/applications/density/checked_values.hpp"
#include "lib/applications/density/pointwise.hpp"
#include "lib/base/nodal_values.hpp"

namespace powercell {
namespace {

/// The affine function on each region. On a surface the gradient is tangential.
class LinearSource : public PointSource {
 public:
  LinearSource(const RegionsView& mesh, std::span<const double> values) : mesh_(mesh), values_(values) {}

  void evaluate(std::span<const Point> x, std::uint32_t region, std::span<double> values) override {
    if (region != known_) {
      function_ = affine_in_region(mesh_, region, values_);
      known_ = region;
    }
    for (std::size_t k = 0; k < x.size(); ++k) values[k] = function_(x[k]);
  }

 private:
  RegionsView mesh_;
  std::span<const double> values_;
  std::uint32_t known_ = ~std::uint32_t{0};
  AffineFunction function_;
};

class Nodal : public PointwiseDensity {
 public:
  explicit Nodal(std::span<const double> values)
      : PointwiseDensity(unused_tolerance), values_(values.begin(), values.end()) {
    check_densities(values, std::to_string(values.size()) + " values at vertices",
                    [](std::size_t k) { return "vertex " + std::to_string(k); });
  }

  std::unique_ptr<PointSource> source(const Domain& domain) const override {
    const RegionsView mesh = domain.regions();
    require_simplices(domain);
    if (values_.size() * 3 != mesh.vertices.size())
      throw Error(ErrorCode::invalid_argument, std::to_string(values_.size()) +
                                                   " values of the density for a mesh of " +
                                                   std::to_string(mesh.vertices.size() / 3) + " vertices");
    return std::make_unique<LinearSource>(mesh, values_);
  }

 protected:
  bool linear() const override { return true; }

 private:
  static constexpr double unused_tolerance = 1e-9;  // linear() densities are integrated exactly
  std::vector<double> values_;
};

}  // namespace

DensityModelPtr make_nodal(std::span<const double> values) {
  return std::make_shared<Nodal>(values);
}

}  // namespace powercell
