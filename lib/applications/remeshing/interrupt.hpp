/// \file
/// Telling how far remeshing is, and stopping it.
#pragma once

#include <cstddef>
#include <functional>
#include <powercell/error.hpp>

namespace powercell::remeshing {

/// One step of several, which tells the caller how much of all is done. The caller may stop at each call.
class Progress {
 public:
  Progress() = default;  ///< tells nobody
  /// \param told  called with the fraction done; outlives this; may be empty
  explicit Progress(const std::function<bool(double)>& told) : told_(told ? &told : nullptr) {}

  bool is_told() const { return told_ != nullptr; }
  /// What is done between two fractions of this step.
  Progress part(double from, double to) const {
    Progress result = *this;
    result.from_ = from_ + from * (to_ - from_);
    result.to_ = from_ + to * (to_ - from_);
    result.done_ = 0;
    return result;
  }
  /// \throw Error interrupted
  void at(double done) {
    done_ = done;
    if (!goes_on()) throw Error(ErrorCode::interrupted, "interrupted");
  }
  /// For each of many things: tells again now and then. \throw Error interrupted
  /// \param work  it takes some hundred microseconds at most, times this
  void tick(std::size_t work = 1) {
    constexpr std::size_t between = 256;
    ticks_ += work;
    if (ticks_ < between) return;
    ticks_ = 0;
    at(done_);
  }
  /// Tells; false if the caller wants to stop.
  bool goes_on() const { return told_ == nullptr || (*told_)(from_ + done_ * (to_ - from_)); }

 private:
  const std::function<bool(double)>* told_ = nullptr;
  double from_ = 0, to_ = 1, done_ = 0;
  std::size_t ticks_ = 0;
};

}  // namespace powercell::remeshing
