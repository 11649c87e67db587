/// \file
/// How even a set of points is: spacing, order, and spectra.
#pragma once

#include <cstddef>
#include <cstdint>
#include <powercell/density.hpp>
#include <span>
#include <vector>

namespace powercell {

/// n points drawn at random with a density, in the domain; the same ones for the same random seed. Where
/// fewer than one in 4096 uniform points would stay, the domain is divided by integrals of the density: peaks
/// are found from their flanks, however narrow. Without flanks, sharp spots may be too small (about 1e-5 of
/// the domain). \return n x d, row-major   \param density  a value is needed at points: any kind but those of
/// the wrong domain \throw Error invalid_argument if the density is positive in too small a part of the
/// domain, or drops to nothing around such a part; as Density::total
POWERCELL_API std::vector<double> random_points(const Domain& domain, const Density& density, std::size_t n,
                                                std::uint64_t random_seed);

/// Distances and angles between neighbours, those of the points' Voronoi cells.
struct Spacing {
  /// Least and mean distance of a point from its nearest, over the largest that all distances can have: in
  /// the hexagonal lattice of the same density, or on volumes in the face-centred cubic one. With a density
  /// that varies each distance is taken over that of a lattice with cells as large as the point's. Of points
  /// that have neighbours; NaN where none has.
  double least = 0, mean = 0;
  /// Mean over the points of |mean over neighbours of exp(6 i angle)|: 1 in the hexagonal lattice, about .37
  /// at random. NaN unless the domain is in the plane.
  double hexatic = 0;
};

/// \param positions  n x d, row-major, in the domain
/// \param periodic   the domain is a box of the plane with its opposite sides identified
/// \param uniform    the points are meant to have the same density everywhere
/// \throw as Diagram; invalid_argument for less than two points; unsupported for a periodic domain that is no
/// box
POWERCELL_API Spacing spacing(const Device& device, const Domain& domain, std::span<const double> positions,
                              bool periodic = false, bool uniform = true, const Options& options = {});

/// Power spectrum of points in a periodic box, P(f) = |sum over j of exp(-2 pi i f.x_j)|^2 / n, with
/// frequencies f of whole numbers of waves over width and height. 1 on average for random points.
struct Spectrum {
  int highest = 0;            ///< F: components of f go from -F to F
  std::vector<double> power;  ///< (2F+1) x (2F+1), row-major, rows by f_y and columns by f_x, ascending
  std::size_t points = 0;     ///< n
  std::size_t runs = 1;       ///< sets of points averaged over

  /// By |f| = 1, 2, ... F: the mean of the power over the ring of width 1, and the variance over the square
  /// of that mean (isotropic: 1 / runs).
  struct Radial {
    std::vector<double> mean, anisotropy;
  };
  POWERCELL_API Radial radial() const;
  /// Mean power of frequencies 0 < |f| <= fraction * sqrt(n).
  POWERCELL_API double low_frequency(double fraction = 0.5) const;
};

/// \param positions  n x 2, row-major   \param box  of the plane
/// \param highest  F; 0 means 2 sqrt(n)   \param threads  0 means all
/// \throw Error invalid_argument for no points; unsupported unless the domain is in the plane
POWERCELL_API Spectrum spectrum(const Domain& box, std::span<const double> positions, int highest = 0,
                                int threads = 0);

/// The mean of spectra of the same size. \throw Error invalid_argument if there are none, or of several sizes
POWERCELL_API Spectrum mean(std::span<const Spectrum> spectra);

}  // namespace powercell
