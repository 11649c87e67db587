/// \file
/// Random points, and measures of how even a set of points is: spacing, hexatic order and spectra.
#pragma once

#include <cstddef>
#include <cstdint>
#include <powercell/density.hpp>
#include <span>
#include <vector>

namespace powercell {

/// Draws n independent random points of the domain with the given density; the same random seed gives the
/// same points. Rejection sampling; if it would keep fewer than one in 4096 uniform points, the domain is
/// subdivided by integrals of the density, which finds a peak of any width by its flanks. A spot with a sharp
/// edge and no flanks may be too small to be found (below about 1e-5 of the domain).
/// \return n x d, row-major
/// \throw Error invalid_argument if the density is positive in too small a part of the domain, or falls too
///   steeply around such a part; as Density::total
POWERCELL_API std::vector<double> random_points(const Domain& domain, const Density& density, std::size_t n,
                                                std::uint64_t random_seed);

/// Distances and angles between Voronoi neighbours.
struct Spacing {
  /// Least and mean distance of a point to its nearest neighbour, divided by the distance of neighbours in
  /// the densest lattice (hexagonal, in volumes face-centred cubic) with cells of the same measure: the mean
  /// measure if the points are uniform, else that of each point's cell. Over the points that have neighbours;
  /// NaN if there are none.
  double least = 0, mean = 0;
  /// Hexatic order: mean over the points of |mean over their neighbours of exp(6 i angle)|. 1 in the
  /// hexagonal lattice, about 0.37 for random points. NaN unless the domain is in the plane.
  double hexatic = 0;
};

/// Measures the spacing of points.
/// \param positions  n x d, row-major, in the domain
/// \param periodic   the domain is a box with its opposite sides identified: short for Domain::periodic_box
/// \param uniform    the points are meant to have constant density
/// \throw Error invalid_argument (fewer than two points; a point without a cell, as those given twice or far
/// outside),
///   unsupported (a periodic domain that is not a box); as Diagram
POWERCELL_API Spacing spacing(const Device& device, const Domain& domain, std::span<const double> positions,
                              bool periodic = false, bool uniform = true, const Options& options = {});

/// Power spectrum of n points in a periodic box, P(f) = |sum over j of exp(-2 pi i f.x_j)|^2 / n. The
/// components of the frequency f are whole numbers of waves per width and height. Random points have P = 1 on
/// average.
struct Spectrum {
  int highest = 0;            ///< F: components of f range from -F to F
  std::vector<double> power;  ///< (2F+1) x (2F+1), row-major: rows by f_y, columns by f_x, both ascending
  std::size_t points = 0;     ///< n
  std::size_t runs = 1;       ///< number of point sets averaged

  /// For |f| = 1, 2, ... F: mean of the power over a ring of width 1, and its anisotropy, the variance over
  /// the ring divided by the square of the mean (1 / runs if isotropic). F entries each.
  struct Radial {
    std::vector<double> mean, anisotropy;
  };
  POWERCELL_API Radial radial() const;
  /// Mean power over the frequencies 0 < |f| <= fraction * sqrt(n); 0 if there are none.
  POWERCELL_API double low_frequency(double fraction = 0.5) const;
};

/// Computes the power spectrum of points.
/// \param box        its bounding box is the period
/// \param positions  n x 2, row-major
/// \param highest    F; 0 means 2 sqrt(n), rounded up
/// \param threads    on the host; 0 means all
/// \throw Error invalid_argument (no points; highest < 0), invalid_seed (not finite: which), unsupported (a
///   domain that is not in the plane)
POWERCELL_API Spectrum spectrum(const Domain& box, std::span<const double> positions, int highest = 0,
                                int threads = 0);

/// Averages spectra, weighted by their runs.
/// \throw Error invalid_argument if there are none, or they differ in F or n
POWERCELL_API Spectrum mean(std::span<const Spectrum> spectra);

}  // namespace powercell
