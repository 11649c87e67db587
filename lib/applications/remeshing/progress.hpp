/// \file
/// Progress reports of remeshing, through which the caller may interrupt it.
#pragma once

#include <cstddef>
#include <functional>
#include <powercell/error.hpp>

namespace powercell::remeshing {

/// Reports the progress of one step of several as a fraction of the whole. The callback may ask to stop at
/// each report.
class Progress {
 public:
  Progress() = default;  ///< without reports
  /// \param callback  called with the fraction done, returns false to stop; outlives this; may be empty
  explicit Progress(const std::function<bool(double)>& callback)
      : callback_(callback ? &callback : nullptr) {}

  bool has_callback() const { return callback_ != nullptr; }
  /// The part of this step between two fractions of it.
  Progress part(double from, double to) const {
    Progress result = *this;
    result.from_ = from_ + from * (to_ - from_);
    result.to_ = from_ + to * (to_ - from_);
    result.done_ = 0;
    return result;
  }
  /// Reports a fraction of this step.
  /// \throw Error interrupted
  void at(double done) {
    done_ = done;
    if (!report()) throw Error(ErrorCode::interrupted, "interrupted");
  }
  /// To be called for each of many items: repeats the last report from time to time.
  /// \param work  cost of the item, in units of at most some hundred microseconds
  /// \throw Error interrupted
  void tick(std::size_t work = 1) {
    constexpr std::size_t between = 256;  // units of work from one report to the next
    ticks_ += work;
    if (ticks_ < between) return;
    ticks_ = 0;
    at(done_);
  }
  /// Repeats the last report.
  /// \return false if the caller asks to stop
  bool report() const { return callback_ == nullptr || (*callback_)(from_ + done_ * (to_ - from_)); }

 private:
  const std::function<bool(double)>* callback_ = nullptr;
  double from_ = 0, to_ = 1, done_ = 0;
  std::size_t ticks_ = 0;
};

}  // namespace powercell::remeshing
