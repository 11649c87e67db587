/// \file
/// What a density is made of. Internal.
#pragma once

#include <powercell/density.hpp>

namespace powercell {

using Point = std::array<double, 3>;  // third coordinate 0 in 2D

/// Values of a density; one for each thread.
struct PointSource {
  virtual ~PointSource() = default;
  /// \param x       points of one region
  /// \param values  as many
  virtual void evaluate(std::span<const Point> x, std::uint32_t region, std::span<double> values) = 0;
};

struct DensityModel {
  virtual ~DensityModel() = default;
  virtual double total(const Domain& domain, int threads) const = 0;
  /// Everything but domain_mass. \param options  with the number of threads
  virtual DensityIntegrals integrate(Diagram& diagram, const IntegrationOptions& options) const = 0;
  /// \throw Error unsupported, invalid_argument if the density does not go with the domain
  virtual std::unique_ptr<PointSource> source(const Domain& domain) const = 0;
  virtual bool is_constant() const { return false; }
  /// Whether integrals are exact but for rounding, whatever the tolerance.
  virtual bool exact() const { return is_constant(); }
};

}  // namespace powercell
