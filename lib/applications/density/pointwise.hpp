/// \file
/// Densities that are evaluated at points and integrated by nested rules on simplices.
#pragma once

#include "lib/applications/density/geometric.hpp"

namespace powercell {

class PointwiseDensity : public GeometricDensity {
 public:
  bool exact() const override { return linear(); }

 protected:
  /// \param tolerance  of the mass of a simplex, relative
  explicit PointwiseDensity(double tolerance) : tolerance_(tolerance) {}
  /// Whether the density is affine in each region: then the rule of degree 3 is exact.
  virtual bool linear() const { return false; }
  std::unique_ptr<PieceIntegrator> integrator(const Domain& domain, const Accuracy& accuracy) const override;

 private:
  double tolerance_;
};

}  // namespace powercell
