/// \file
/// Densities on a domain, and the integrals of a density over the cells of a diagram.
#pragma once

#include <memory>
#include <powercell/diagram.hpp>
#include <vector>

namespace powercell {

struct DensityModel;  // what a density is made of (library-internal)

/// An immutable density: mass for each unit of area or volume, nowhere negative. Copies share one state.
/// Safe to share between threads.
class POWERCELL_API Density {
 public:
  /// The same everywhere. \throw Error invalid_argument unless finite and positive
  static Density constant(double value);

  bool is_constant() const;
  /// The integral over a domain, to the accuracy that integrate() has. \param threads 0 means all
  double total(const Domain& domain, int threads = 0) const;

  explicit Density(std::shared_ptr<const DensityModel> model) : model_(std::move(model)) {}
  /// For the library's own use.
  const DensityModel& model() const { return *model_; }

 private:
  std::shared_ptr<const DensityModel> model_;
};

/// Integrals of a density over each cell, all from the same quadrature. n seeds, d coordinates.
struct POWERCELL_API DensityIntegrals {
  int dimension = 0;             ///< d
  std::vector<double> mass;      ///< n: integral of rho over the cell; 0 where empty
  std::vector<double> centroid;  ///< n x d, row-major: integral of rho x, over the mass; NaN where that is 0
  std::vector<double> second_moment;  ///< n: integral of rho |x - p_i|^2
  std::vector<SeedStatus> status;     ///< n: of the cells, whatever their mass
  double domain_mass = 0;             ///< Density::total of the domain
  /// Where asked for: integrals of rho over the walls, so that (15) of docs/mathematics.md gives the
  /// derivatives of `mass` by the weights. The neighbours of a cell are those of Diagram::adjacency().
  Adjacency walls;

  double total() const;           ///< sum of the masses, compensated
  double relative_error() const;  ///< |total() - domain_mass| / domain_mass
};

/// Integrates a density over the cells of a diagram, from its measures and adjacency where the density is
/// constant, else from the geometry of its cells. The same bits for every number of threads.
/// \param walls    also those over the walls
/// \param threads  on the host; 0 means all
/// \throw as Diagram
POWERCELL_API DensityIntegrals integrate(Diagram& diagram, const Density& density, bool walls,
                                         int threads = 0);

}  // namespace powercell
