/// \file
/// Checks of values that callers provide: lists of values, and values computed by formulas and functions.
#pragma once

#include <limits>
#include <powercell/error.hpp>
#include <string>

#include "lib/applications/density/model.hpp"

namespace powercell {

inline bool is_density(double value) {
  return value >= 0 && value <= Density::largest_value;
}

/// \throw Error invalid_argument, which names the value and the place
[[noreturn]] void refuse_density(double value, const std::string& where);

/// Checks a list of values: each must be a density, and one must be positive.
/// \param list     names the list in messages
/// \param name_of  names value k, e.g. "pixel 3, 4"
/// \throw Error invalid_argument
template <class Name>
void check_densities(std::span<const double> values, const std::string& list, const Name& name_of) {
  bool any = false;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!is_density(values[k])) refuse_density(values[k], name_of(k));
    any |= values[k] > 0;
  }
  if (!any) throw Error(ErrorCode::invalid_argument, list + ": the density is 0 everywhere");
}

/// Checks values that a caller's code computes. They must be densities within the domain only. Rounding puts
/// vertices of cells beyond its boundary, where a formula such as sqrt(1 - x - y) has no value: if it is
/// negative or NaN there, the value of a point slightly closer to the middle of the region takes its place.
class CheckedSource : public PointSource {
 public:
  explicit CheckedSource(const Domain& domain) : domain_(domain) {}
  /// \throw Error invalid_argument if a value is not a density, with the place
  void evaluate(std::span<const Point> x, std::uint32_t region, std::span<double> values) final;

 protected:
  /// As evaluate, with any values.
  virtual void evaluate_unchecked(std::span<const Point> x, std::span<double> values) = 0;

 private:
  double evaluate_inwards(const Point& x, std::uint32_t region, double value);

  Domain domain_;
  std::uint32_t region_ = std::numeric_limits<std::uint32_t>::max();  // the region of middle_
  Point middle_{};
};

}  // namespace powercell
