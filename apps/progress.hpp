/// \file
/// The stages of a run: one progress bar for all of them on stderr, and the seconds that each took.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace powercell::app {

/// Names of stages that several commands have.
namespace stage {
inline constexpr const char *reading = "reading", *opening = "opening the device", *writing = "writing";
}

/// A part of a run.
struct Stage {
  std::string name;  ///< shown beside the bar: "reading"
  double weight;     ///< usual share of the time, relative to the other stages
};

/// Follows a run through its stages. The bar goes from 0 to 100 % and never back; it is drawn on a terminal
/// alone, after some time, and erased at the end. Seconds of stages do not contain the compilation of
/// kernels.
class Progress {
 public:
  /// Begins the first of the stages.
  /// \param silent  never draw
  Progress(std::vector<Stage> stages, bool silent);
  ~Progress();  ///< erases the bar of a run that failed
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Ends the stage before it. Stages may be left out, but keep their order.
  void begin(std::string_view stage);
  /// Names what the stage works on, for the rate: 20,000 "cells".
  void count(double items, std::string unit);
  /// What the stage has come to, shown instead of the rate: "step 12".
  void note(std::string text);
  /// What is shown while kernels are compiled.
  void building(std::string text);
  /// From here on reported fractions refer to this part of the stage.
  void part(double from, double to);
  /// Reports a fraction of the part.
  /// \return false if the user asks to stop (interrupt.hpp)
  bool at(double fraction);
  /// at() as the library's options take it; for the time of this object.
  std::function<bool(double)> callback();
  /// Runs `print`, which may write to the terminal, without the bar.
  void aside(const std::function<void()>& print);
  /// Ends the last stage, draws 100 % and erases the bar.
  void finish();

  /// Seconds of a stage so far; 0 before it begins.
  double seconds(std::string_view stage) const;
  double build() const;  ///< seconds of compiling kernels so far
  double run() const;    ///< seconds of the run so far: the sum of all stages and build()

 private:
  using Clock = std::chrono::steady_clock;
  struct Spent {
    double seconds = 0, build = 0;
  };

  std::size_t index_of(std::string_view stage) const;
  Spent spent() const;
  double now() const;          // seconds of the stage so far
  double done() const;         // fraction of the run
  std::string status() const;  // what is shown beside the bar
  void lap();
  void draw();
  void wipe();
  void end(bool complete);
  void draw_from_time_to_time();

  std::vector<Stage> stages_;
  std::vector<double> seconds_;  // of each stage that has ended
  std::vector<double> start_;    // fraction of the run at the beginning of each stage, and 1
  std::size_t stage_ = 0;
  double items_ = 0;
  std::string unit_, note_, building_ = "compiling kernels, first run only";
  double from_ = 0, to_ = 1;  // the part of the stage
  double reached_ = 0;        // fraction of the stage
  Clock::time_point run_start_ = Clock::now();
  Spent stage_start_;
  double build_start_;
  bool ended_ = false, complete_ = false;

  mutable std::mutex mutex_;  // guards all members, since a thread draws
  std::condition_variable wake_;
  std::size_t drawn_ = 0;                            // characters on the terminal
  std::optional<Clock::time_point> building_since_;  // while kernels are compiled
  std::thread drawer_;
};

/// How far an iteration is whose number of steps is not known.
class Approach {
 public:
  /// \param share  of the way to the goal, as far as this step shows it; NaN if it does not
  /// \return the fraction done: never less than before, and a little more after each step
  double step(double share);

 private:
  double done_ = 0;
};

/// How far a value has come from its first one to a goal near 0, on a logarithmic scale.
double logarithmic_share(double value, double first, double goal);

}  // namespace powercell::app
