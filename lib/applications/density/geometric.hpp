/// \file
/// Densities that are integrated over the geometry of cells.
#pragma once

#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "lib/applications/density/model.hpp"
#include "lib/applications/density/piece.hpp"

namespace powercell {

/// Integrates over pieces. Not thread-safe: each thread has its own.
struct PieceIntegrator {
  virtual ~PieceIntegrator() = default;
  /// Adds the integrals over a piece, about the origin of `moments`.
  virtual void add(const Piece& piece, Moments& moments) = 0;
  /// The integral of the density over a face of a piece.
  virtual double over_face(const Piece& piece, std::uint64_t face) = 0;
};

/// How finely pieces are subdivided before the error estimate of a rule is trusted (docs/mathematics.md,
/// below (32)): longest edge of a simplex.
struct Resolution {
  double anywhere = std::numeric_limits<double>::infinity();
  /// In the ball that holds most of the density, if that is a small part of the domain.
  double in_ball = std::numeric_limits<double>::infinity();
  Point center{};
  double radius = 0;
};

/// Options of adaptive integrators.
struct Accuracy {
  double tolerance = 0;           ///< relative, of masses; used if looser than the integrator's own
  double negligible_density = 0;  ///< densities below count as this one when errors are compared with them
  Resolution resolution{};
  int extra_depth = 0;  ///< additional levels of bisection, for large pieces
  bool jumps = false;   ///< the density has jumps: also look for those that pass between the points of a rule
};

class GeometricDensity : public DensityModel {
 public:
  double total(const Domain& domain, int threads) const override;
  DensityIntegrals integrate(Diagram& diagram, const IntegrationOptions& options) const override;
  /// The masses of arbitrary cells, whose regions are those of the domain.
  std::vector<double> masses(const Domain& domain, const Cells& cells, const Accuracy& accuracy,
                             int threads) const;

 protected:
  /// \throw Error unsupported, invalid_argument if the density does not go with the domain
  virtual std::unique_ptr<PieceIntegrator> integrator(const Domain& domain,
                                                      const Accuracy& accuracy) const = 0;

 private:
  /// The density as a whole on a domain.
  struct Summary {
    Domain domain;
    double total;
    Resolution resolution;
    bool jumps;
  };
  Summary summary(const Domain& domain, int threads) const;

  mutable std::mutex mutex_;
  mutable std::optional<Summary> last_summary_;  // for the domain used last
};

}  // namespace powercell
