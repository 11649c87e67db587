/// \file
/// The worst offender against a law. Internal.
#pragma once

#include <powercell/verify.hpp>
#include <string>
#include <utility>

namespace powercell {

/// Keeps the finding that is worst relative to its tolerance.
class Worst {
 public:
  /// \param describe  gives the text that names the place; called only if this finding is the worst so far
  /// and
  ///   exceeds its tolerance
  template <class Describe>
  void see(double value, double allowed, const Describe& describe) {
    // NaN is a fault too, hence the negated comparisons.
    const double ratio = value == 0 ? 0 : allowed > 0 ? value / allowed : infinite;
    if (ratio <= ratio_) return;
    ratio_ = ratio > ratio_ ? ratio : infinite;
    value_ = value;
    allowed_ = allowed;
    if (!(value <= allowed)) detail_ = describe();
  }

  void see(const Worst& other) {
    if (other.ratio_ > ratio_) *this = other;
  }

  /// \param usual  the tolerance to report if nothing was measured
  LawCheck result(std::string law, double usual) const {
    const bool any = ratio_ > 0;
    return {std::move(law), !(ratio_ > 1), value_, any ? allowed_ : usual, detail_};
  }

 private:
  static constexpr double infinite = 1e300;
  double ratio_ = 0, value_ = 0, allowed_ = 0;
  std::string detail_;
};

}  // namespace powercell
