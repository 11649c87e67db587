/// \file
/// Densities that are integrated over the geometry of the cells. Internal.
#pragma once

#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "lib/applications/density/model.hpp"
#include "lib/applications/density/piece.hpp"

namespace powercell {

/// Integrates over pieces; one for each thread.
struct PieceIntegrator {
  virtual ~PieceIntegrator() = default;
  /// Adds the integrals over a piece, about the origin of `moments`.
  virtual void add(const Piece& piece, Moments& moments) = 0;
  /// The integral of the density over a face of a piece.
  virtual double over_face(const Piece& piece, std::uint64_t face) = 0;
};

/// How finely pieces are divided before an estimate is believed. (docs/mathematics.md, below (32))
struct Grain {
  double anywhere = std::numeric_limits<double>::infinity();  ///< longest edge
  /// In the ball that has most of a density that lies in a small part of the domain.
  double dense = std::numeric_limits<double>::infinity();
  Point center{};
  double radius = 0;
};

/// What adaptive integrators need to know.
struct Accuracy {
  double tolerance = 0;           ///< of masses, where it is looser than the integrator's own
  double negligible_density = 0;  ///< errors of the tolerance times this, times the volume, don't count
  Grain grain{};
  int more_depth = 0;  ///< further bisections, for pieces that are large
  bool jumps = false;  ///< the density has jumps: what passes between the points of a rule is looked for
};

class GeometricDensity : public DensityModel {
 public:
  double total(const Domain& domain, int threads) const override;
  DensityIntegrals integrate(Diagram& diagram, const IntegrationOptions& options) const override;
  /// The integrals over cells of one's own, with the regions of the domain.
  std::vector<double> masses(const Domain& domain, const Cells& cells, const Accuracy& accuracy,
                             int threads) const;

 protected:
  /// \throw Error unsupported, invalid_argument if the density does not go with the domain
  virtual std::unique_ptr<PieceIntegrator> integrator(const Domain& domain,
                                                      const Accuracy& accuracy) const = 0;

 private:
  struct Known {
    Domain domain;
    double total;
    Grain grain;
    bool jumps;
  };
  Known known(const Domain& domain, int threads) const;

  mutable std::mutex mutex_;
  mutable std::optional<Known> last_known_;  // the last domain asked for
};

}  // namespace powercell
