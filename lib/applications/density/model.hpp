/// \file
/// The implementations behind Density.
#pragma once

#include <powercell/density.hpp>

namespace powercell {

using Point = std::array<double, 3>;  // third coordinate 0 in 2D

/// Evaluates a density at points. Not thread-safe: each thread has its own.
struct PointSource {
  virtual ~PointSource() = default;
  /// \param x       points of one region of the domain
  /// \param values  output, as many
  virtual void evaluate(std::span<const Point> x, std::uint32_t region, std::span<double> values) = 0;
};

struct DensityModel {
  virtual ~DensityModel() = default;
  virtual double total(const Domain& domain, int threads) const = 0;
  /// Computes everything but domain_mass.
  /// \param options  with the actual number of threads
  virtual DensityIntegrals integrate(Diagram& diagram, const IntegrationOptions& options) const = 0;
  /// The source may refer to this model.
  /// \throw Error unsupported, invalid_argument if the density does not fit the domain
  virtual std::unique_ptr<PointSource> source(const Domain& domain) const = 0;
  virtual bool is_constant() const { return false; }
  /// Whether integrals are exact up to rounding, whatever the tolerance.
  virtual bool exact() const { return is_constant(); }
};

/// The kinds of densities. Each throws as the function of Density with its name.
using DensityModelPtr = std::shared_ptr<const DensityModel>;

DensityModelPtr make_constant(double value);
DensityModelPtr make_formula(std::string_view expression, double tolerance);
DensityModelPtr make_function(std::function<double(const std::array<double, 3>&)> value, double tolerance);
DensityModelPtr make_image(const ImageView& image);
DensityModelPtr make_nodal(std::span<const double> values);

}  // namespace powercell
