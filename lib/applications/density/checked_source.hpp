/// \file
/// Densities that callers' code tells point by point. Internal.
#pragma once

#include <limits>

#include "lib/applications/density/model.hpp"

namespace powercell {

/// Checks values, which are needed within the domain only: vertices of cells on its boundary lie beyond it
/// by their rounding, and where a value there is none it is that of a point a little nearer to the middle of
/// the region.
class CheckedSource : public PointSource {
 public:
  explicit CheckedSource(const Domain& domain) : domain_(domain) {}
  /// \throw Error invalid_argument if a value is negative or not finite
  void evaluate(std::span<const Point> x, std::uint32_t region, std::span<double> values) final;

 protected:
  /// As evaluate, with any values.
  virtual void ask(std::span<const Point> x, std::span<double> values) = 0;

 private:
  double ask_inside(const Point& x, std::uint32_t region, double value);

  Domain domain_;
  std::uint32_t region_ = std::numeric_limits<std::uint32_t>::max();  // that middle_ is of
  Point middle_{};
};

}  // namespace powercell
