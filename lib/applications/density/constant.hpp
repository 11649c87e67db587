/// \file
/// The same density everywhere: measures and walls times a number. Internal.
#pragma once

#include "lib/applications/density/model.hpp"

namespace powercell {

class ConstantDensity : public DensityModel {
 public:
  explicit ConstantDensity(double value) : value_(value) {}
  double total(const Domain& domain, int threads) const override;
  DensityIntegrals integrate(Diagram& diagram, const IntegrationOptions& options) const override;
  std::unique_ptr<PointSource> source(const Domain& domain) const override;
  bool is_constant() const override { return true; }

 private:
  double value_;
};

}  // namespace powercell
