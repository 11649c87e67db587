/// \file
/// Densities that can be evaluated at points, integrated by nested rules on simplices. Internal.
#pragma once

#include <span>

#include "lib/density/geometric.hpp"

namespace powercell {

/// Values of a density; one for each thread.
struct PointSource {
  virtual ~PointSource() = default;
  /// \param x       points of one region
  /// \param values  as many
  virtual void evaluate(std::span<const Point> x, std::uint32_t region, std::span<double> values) = 0;
};

class PointwiseDensity : public GeometricDensity {
 protected:
  /// \param tolerance  relative, of the mass of a simplex
  explicit PointwiseDensity(double tolerance) : tolerance_(tolerance) {}
  virtual std::unique_ptr<PointSource> source(const Domain& domain) const = 0;
  /// True if the density is a polynomial of degree 1 in each region: then a rule of degree 3 is exact.
  virtual bool linear() const { return false; }
  std::unique_ptr<PieceIntegrator> integrator(const Domain& domain, const Accuracy& accuracy) const override;

 private:
  double tolerance_;
};

}  // namespace powercell
