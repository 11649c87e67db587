#include <algorithm>
#include <cmath>
#include <powercell/regions.hpp>
#include <vector>

#include "lib/applications/density/checked_values.hpp"
#include "lib/applications/density/pointwise.hpp"

namespace powercell {
namespace {

/// The affine function on a region, as its value at a corner and its gradient. On a surface the gradient is
/// tangential.
class LinearSource : public PointSource {
 public:
  LinearSource(const RegionsView& mesh, std::span<const double> values) : mesh_(mesh), values_(values) {}

  void evaluate(std::span<const Point> x, std::uint32_t region, std::span<double> values) override {
    if (region != known_) set_region(region);
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Point y = x[k] - origin_;
      values[k] = value_ + gradient_[0] * y[0] + gradient_[1] * y[1] + gradient_[2] * y[2];
    }
  }

 private:
  Point vertex(std::uint32_t v) const {
    return {mesh_.vertices[3 * v], mesh_.vertices[3 * v + 1], mesh_.vertices[3 * v + 2]};
  }

  void set_region(std::uint32_t region) {
    const std::uint32_t* corner = &mesh_.region_vertex[mesh_.region_offset[region]];
    origin_ = vertex(corner[0]);
    value_ = values_[corner[0]];
    Point a = vertex(corner[1]) - origin_, b = vertex(corner[2]) - origin_, c{};
    const double da = values_[corner[1]] - value_, db = values_[corner[2]] - value_;
    double dc = 0;
    if (mesh_.cell_dimension == 3) {
      c = vertex(corner[3]) - origin_;
      dc = values_[corner[3]] - value_;
    }
    // In units of the region's size: products of four lengths may overflow.
    double size = 0;
    for (const Point* edge : {&a, &b, &c})
      for (const double x : *edge) size = std::max(size, std::abs(x));
    for (Point* edge : {&a, &b, &c})
      for (double& x : *edge) x /= size;
    if (mesh_.cell_dimension == 2) c = cross(a, b);  // the value is constant along the normal
    const Point bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double determinant = dot(a, bc);
    for (std::size_t k = 0; k < 3; ++k)
      gradient_[k] = (da * bc[k] + db * ca[k] + dc * ab[k]) / determinant / size;
    known_ = region;
  }

  RegionsView mesh_;
  std::span<const double> values_;
  std::uint32_t known_ = ~std::uint32_t{0};
  Point origin_{}, gradient_{};
  double value_ = 0;
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
    if (domain.kind() == DomainKind::polygon || mesh.shape == RegionShape::box)
      throw Error(ErrorCode::unsupported,
                  "a density given at vertices needs a mesh of triangles or tetrahedra as domain");
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
