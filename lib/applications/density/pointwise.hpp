/// \file
/// Densities that can be evaluated at points, integrated by nested rules on simplices. Internal.
#pragma once

#include "lib/applications/density/geometric.hpp"

namespace powercell {

class PointwiseDensity : public GeometricDensity {
 public:
  bool exact() const override { return linear(); }

 protected:
  /// \param tolerance  relative, of the mass of a simplex
  explicit PointwiseDensity(double tolerance) : tolerance_(tolerance) {}
  /// True if the density is a polynomial of degree 1 in each region: then a rule of degree 3 is exact.
  virtual bool linear() const { return false; }
  std::unique_ptr<PieceIntegrator> integrator(const Domain& domain, const Accuracy& accuracy) const override;

 private:
  double tolerance_;
};

}  // namespace powercell
