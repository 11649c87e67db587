/// \file
/// Densities on a domain, and the integrals of a density over the cells of a diagram.
#pragma once

#include <functional>
#include <memory>
#include <powercell/diagram.hpp>
#include <vector>

namespace powercell {

struct DensityModel;  // implementation of a density (library-internal)

/// Gray values of pixels that fill an axis-aligned rectangle. A view: the caller owns the values and keeps
/// them alive during the call.
struct ImageView {
  std::size_t width = 0, height = 0;
  std::span<const double> values;    ///< height x width, row-major from the top row (largest y) down, >= 0
  std::array<double, 2> low{0, 0};   ///< lower left corner of the rectangle
  std::array<double, 2> high{1, 1};  ///< upper right corner of the rectangle
};

/// An immutable density: mass per unit of area or volume, between 0 and `largest_value` everywhere. Copies
/// share one state. Safe to share between threads.
class POWERCELL_API Density {
 public:
  /// Upper limit of a density: its products with areas and squared distances stay within the range of
  /// doubles.
  static constexpr double largest_value = 1e100;

  /// The same value everywhere.
  /// \throw Error invalid_argument unless 0 < value <= largest_value
  static Density constant(double value);

  /// An expression in x, y and z, evaluated by muparser: + - * / ^, comparisons, `a ? b : c`, sin, exp, sqrt,
  /// abs, min, max and others, with the constants pi and e. It should be smooth at the scale of the cells:
  /// quadrature is adaptive and reports the remaining error in DensityIntegrals::quadrature_error, but may
  /// miss peaks much narrower than a cell.
  /// \param tolerance  of each mass, relative; between 0 and 1
  /// \throw Error invalid_argument if it is not a valid expression (where); on evaluation, if a value in the
  ///   domain, including its boundary, is negative, not finite or above largest_value (where)
  static Density formula(std::string_view expression, double tolerance = 1e-9);

  /// As formula(), for a function of a point (third coordinate 0 in 2D). Several threads call it at a time.
  static Density function(std::function<double(const std::array<double, 3>&)> value, double tolerance = 1e-9);

  /// Constant in each pixel of an image and 0 outside its rectangle. The integrals are exact. Polygons only.
  /// \throw Error invalid_argument (sizes; a value below 0 or above largest_value: which; all values 0);
  ///   on evaluation, unsupported if the domain is not a polygon
  static Density image(const ImageView& image);

  /// Linear in each triangle or tetrahedron. The integrals are exact.
  /// \param values  one per vertex, in the order passed to Domain::surface or Domain::volume; copied
  /// \throw Error invalid_argument (a value below 0 or above largest_value: which; all values 0); on
  ///   evaluation, unsupported if the domain is not a mesh, invalid_argument if its vertices are not as many
  static Density nodal(std::span<const double> values);

  bool is_constant() const;
  /// Whether integrals are exact up to rounding, whatever the tolerance: true unless a formula or a function.
  bool is_exact() const;
  /// The integral over a domain, as accurate as integrate().
  /// \param threads  on the host; 0 means all
  /// \throw Error invalid_argument if the integral is 0 or above 1e300; as integrate()
  double total(const Domain& domain, int threads = 0) const;

  explicit Density(std::shared_ptr<const DensityModel> model) : model_(std::move(model)) {}
  /// Library-internal.
  const DensityModel& model() const { return *model_; }

 private:
  std::shared_ptr<const DensityModel> model_;
};

/// Integrals of a density rho over each cell, all from the same quadrature. n seeds, d coordinates. Arrays
/// are owned and in the order of the seeds.
struct POWERCELL_API DensityIntegrals {
  int dimension = 0;             ///< d
  std::vector<double> mass;      ///< n: integral of rho over the cell; 0 where empty
  std::vector<double> centroid;  ///< n x d, row-major: integral of rho x, over the mass; NaN if that is 0
  std::vector<double> second_moment;  ///< n: integral of rho |x - p_i|^2
  std::vector<SeedStatus> status;     ///< n: of the cells, regardless of their mass
  double domain_mass = 0;             ///< Density::total of the domain
  /// n: estimated error of the mass where adaptive quadrature reached its limit, plus any negative mass from
  /// rounding (which is set to 0); empty for constant densities.
  std::vector<double> mass_error;
  double quadrature_error = 0;  ///< the largest of mass_error
  /// If requested: integrals of rho over the walls, from which (15) of docs/mathematics.md gives the
  /// derivatives of `mass` with respect to the weights. The neighbours are those of Diagram::adjacency().
  Adjacency walls;

  double total() const;           ///< compensated sum of the masses
  double relative_error() const;  ///< |total() - domain_mass| / domain_mass
};

/// Options of integrate().
struct IntegrationOptions {
  bool walls = false;  ///< integrate over the walls too
  /// If set, called with the n masses before the walls are integrated, unless the density is constant (walls
  /// then cost nothing extra); returning false skips the walls.
  std::function<bool(std::span<const double>)> walls_if;
  /// Relative tolerance of the masses of a formula or function, used if looser than the density's own: for
  /// iterations that do not need full accuracy yet. In [0, 1).
  double tolerance = 0;
  int threads = 0;  ///< on the host; 0 means all
};

/// Integrates a density over the cells of a diagram: from its measures and adjacency if the density is
/// constant, else over the geometry of its cells. The result has the same bits for every number of threads.
/// In a periodic domain the density must be constant; `walls` then have shifts.
/// \throw Error invalid_argument (tolerance out of range), unsupported (periodic; seeds are selected); as
/// Diagram and the density's factory function
POWERCELL_API DensityIntegrals integrate(Diagram& diagram, const Density& density,
                                         const IntegrationOptions& options);

/// The same, to the density's own tolerance.
/// \param walls    integrate over the walls too
/// \param threads  on the host; 0 means all
POWERCELL_API DensityIntegrals integrate(Diagram& diagram, const Density& density, bool walls,
                                         int threads = 0);

}  // namespace powercell
