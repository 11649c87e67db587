/// \file
/// Densities on a domain, and the integrals of a density over the cells of a diagram.
#pragma once

#include <functional>
#include <memory>
#include <powercell/diagram.hpp>
#include <vector>

namespace powercell {

struct DensityModel;  // what a density is made of (library-internal)

/// Gray values of pixels that fill an axis-aligned rectangle. The caller owns them for the length of the
/// call.
struct ImageView {
  std::size_t width = 0, height = 0;
  std::span<const double> values;   ///< height x width, rows from the top (largest y) down, none negative
  std::array<double, 2> low{0, 0};  ///< the lower left corner of the rectangle
  std::array<double, 2> high{1, 1};
};

/// An immutable density: mass for each unit of area or volume, nowhere negative and nowhere above
/// `largest_value`. Copies share one state. Safe to share between threads.
class POWERCELL_API Density {
 public:
  /// Products of densities with areas and with squares of distances are to stay in the range of numbers.
  static constexpr double largest_value = 1e100;

  /// The same everywhere. \throw Error invalid_argument unless positive and at most the largest value
  static Density constant(double value);

  /// An expression in x, y and z, evaluated by muparser: + - * / ^, comparisons, `a ? b : c`, sin, exp, sqrt,
  /// abs, min, max and others, with pi and e. Best smooth at the size of the cells: integrals are adaptive,
  /// and what they could not reach is in DensityIntegrals::quadrature_error; much narrower peaks may be
  /// missed. \param tolerance  relative, of the masses \throw Error invalid_argument if it is no expression
  /// (where); later, if a value in the domain, up to its boundary, is negative or above the largest
  static Density formula(std::string_view expression, double tolerance = 1e-9);

  /// As formula, but a function of a point (third coordinate 0 in 2D), called by several threads at a time.
  static Density function(std::function<double(const std::array<double, 3>&)> value, double tolerance = 1e-9);

  /// Constant in each pixel of an image and 0 outside its rectangle; integrals are exact. For polygons only.
  /// \throw Error invalid_argument (sizes; a value that is negative or above the largest, which; all values
  /// 0)
  static Density image(const ImageView& image);

  /// Linear in each triangle or tetrahedron, from values at the vertices that the domain was made of (as many
  /// and in the order of Domain::surface or Domain::volume); integrals are exact.
  /// \throw Error invalid_argument (a value that is negative or above the largest, which; all values 0);
  /// later, if the domain is no mesh or has another number of vertices
  static Density nodal(std::span<const double> values);

  bool is_constant() const;
  /// Whether integrals are exact but for rounding, whatever the tolerance: no formula and no function is.
  bool is_exact() const;
  /// The integral over a domain, to the accuracy that integrate() has. \param threads 0 means all
  /// \throw Error invalid_argument if it is 0 or above 1e300; as integrate()
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
  /// n: what adaptive rules may have left of a mass where they met their limit, and what rounding left of it
  /// below 0; empty for constants
  std::vector<double> mass_error;
  double quadrature_error = 0;  ///< the largest of mass_error
  /// Where asked for: integrals of rho over the walls, so that (15) of docs/mathematics.md gives the
  /// derivatives of `mass` by the weights. The neighbours of a cell are those of Diagram::adjacency().
  Adjacency walls;

  double total() const;           ///< sum of the masses, compensated
  double relative_error() const;  ///< |total() - domain_mass| / domain_mass
};

/// How integrate() is to go about it.
struct IntegrationOptions {
  bool walls = false;  ///< also those over the walls
  /// Where set, asked with the masses (n) once they are known; false leaves the walls out where they would
  /// cost extra, as they do unless the density is constant.
  std::function<bool(std::span<const double>)> walls_if;
  /// Relative, of the masses, where a formula or function is integrated: one looser than the density's own
  /// takes its place. For iterations that do not need more yet.
  double tolerance = 0;
  int threads = 0;  ///< on the host; 0 means all
};

/// Integrates a density over the cells of a diagram, from its measures and adjacency where the density is
/// constant, else from the geometry of its cells. The same bits for every number of threads.
/// \throw as Diagram
POWERCELL_API DensityIntegrals integrate(Diagram& diagram, const Density& density,
                                         const IntegrationOptions& options);

/// The same to the density's own tolerance. \param walls  also those over the walls
/// \param threads  on the host; 0 means all   \throw as Diagram
POWERCELL_API DensityIntegrals integrate(Diagram& diagram, const Density& density, bool walls,
                                         int threads = 0);

}  // namespace powercell
