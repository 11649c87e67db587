/// \file
/// What a density is made of. Internal.
#pragma once

#include <powercell/density.hpp>

namespace powercell {

struct DensityModel {
  virtual ~DensityModel() = default;
  virtual double total(const Domain& domain, int threads) const = 0;
  /// Everything but domain_mass. \param walls  also the walls
  virtual DensityIntegrals integrate(Diagram& diagram, bool walls, int threads) const = 0;
  virtual bool is_constant() const { return false; }
};

}  // namespace powercell
