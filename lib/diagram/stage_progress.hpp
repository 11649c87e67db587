/// \file
/// One fraction for the stages of a computation. Internal.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>

namespace powercell {

/// Options::progress of a computation of several passes, each of several parts. The fraction never falls,
/// also where a pass is repeated.
class StageProgress {
 public:
  explicit StageProgress(std::function<bool(double)> callback) : callback_(std::move(callback)) {}

  void begin_computation() { reached_ = 0; }
  /// \param from, to  fractions of the computation
  void begin_pass(double from, double to) {
    pass_from_ = from;
    pass_to_ = to;
    begin_part(0, 1);
  }
  /// \param from, to  fractions of the pass
  void begin_part(double from, double to) {
    from_ = pass_from_ + from * (pass_to_ - pass_from_);
    to_ = pass_from_ + to * (pass_to_ - pass_from_);
  }
  /// \param fraction  of the part   \return false if the caller asks to stop
  bool report(double fraction) {
    reached_ = std::max(reached_, from_ + fraction * (to_ - from_));
    return callback_(reached_);
  }

 private:
  std::function<bool(double)> callback_;
  double pass_from_ = 0, pass_to_ = 1;
  double from_ = 0, to_ = 1;
  double reached_ = 0;
};

}  // namespace powercell
