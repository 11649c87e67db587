/// \file
/// The worst offender against a law. Internal.
#pragma once

#include <powercell/verify.hpp>
#include <string>
#include <utility>

namespace powercell {

/// Keeps the finding that is worst in proportion to what was allowed for it.
class Worst {
 public:
  /// \param tell makes the text that says where; called only when this finding is the worst so far and is
  /// more than allowed
  template <class Tell>
  void see(double value, double allowed, const Tell& tell) {
    // Not-a-number is a fault too, hence the negated comparisons.
    const double ratio = value == 0 ? 0 : allowed > 0 ? value / allowed : infinite;
    if (ratio <= ratio_) return;
    ratio_ = ratio > ratio_ ? ratio : infinite;
    value_ = value;
    allowed_ = allowed;
    if (!(value <= allowed)) detail_ = tell();
  }

  void see(const Worst& other) {
    if (other.ratio_ > ratio_) *this = other;
  }

  /// \param usual what is allowed where nothing was found to measure
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
