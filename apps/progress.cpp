#include "apps/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <powercell/device.hpp>
#include <stdexcept>

#include "apps/common.hpp"
#include "apps/interrupt.hpp"

namespace powercell::app {
namespace {

constexpr auto patience = std::chrono::milliseconds(700);  // before the first drawing
constexpr auto period = std::chrono::milliseconds(100);    // between two drawings
constexpr std::size_t bar_width = 24;

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string rounded(double seconds) {
  if (seconds < 9.5) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 95) return fmt::format("{:.0f} s", 5 * std::round(seconds / 5));
  if (seconds < 5700) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

/// "12,000 cells/s", "0.8 cells/s".
std::string rate_of(double rate, const std::string& unit) {
  if (rate < 10) return fmt::format("{:.1f} {}/s", rate, unit);
  const double digit = std::pow(10, std::floor(std::log10(rate)) - 1);  // two of them
  return fmt::format("{} {}/s", with_commas(static_cast<std::size_t>(digit * std::round(rate / digit))),
                     unit);
}

}  // namespace

Progress::Progress(std::vector<Stage> stages, bool silent)
    : stages_(std::move(stages)), seconds_(stages_.size()), build_start_(kernel_builds().seconds) {
  double sum = 0, before = 0;
  for (const Stage& stage : stages_) sum += stage.weight;
  for (const Stage& stage : stages_) {
    start_.push_back(before / sum);
    before += stage.weight;
  }
  start_.push_back(1);
  if (!silent && isatty(STDERR_FILENO) != 0) drawer_ = std::thread([this] { draw_from_time_to_time(); });
}

Progress::~Progress() {
  end(false);
}

Progress::Spent Progress::spent() const {
  const double build = kernel_builds().seconds - build_start_;
  return {std::chrono::duration<double>(Clock::now() - run_start_).count() - build, build};
}

double Progress::now() const {
  return ended_ ? 0 : spent().seconds - stage_start_.seconds;
}

void Progress::lap() {
  const Spent at = spent();
  seconds_[stage_] += at.seconds - stage_start_.seconds;
  stage_start_ = at;
}

std::size_t Progress::index_of(std::string_view stage) const {
  const auto found =
      std::find_if(stages_.begin(), stages_.end(), [&](const Stage& s) { return s.name == stage; });
  if (found == stages_.end()) throw std::logic_error("no stage '" + std::string(stage) + "' was planned");
  return static_cast<std::size_t>(found - stages_.begin());
}

void Progress::begin(std::string_view stage) {
  const std::scoped_lock lock(mutex_);
  lap();
  stage_ = index_of(stage);
  items_ = 0;
  note_.clear();
  from_ = reached_ = 0;
  to_ = 1;
}

void Progress::count(double items, std::string unit) {
  const std::scoped_lock lock(mutex_);
  items_ = items;
  unit_ = std::move(unit);
}

void Progress::note(std::string text) {
  const std::scoped_lock lock(mutex_);
  note_ = std::move(text);
}

void Progress::building(std::string text) {
  const std::scoped_lock lock(mutex_);
  building_ = std::move(text);
}

void Progress::part(double from, double to) {
  const std::scoped_lock lock(mutex_);
  from_ = from;
  to_ = to;
  reached_ = std::max(reached_, from);
}

bool Progress::at(double fraction) {
  {
    const std::scoped_lock lock(mutex_);
    reached_ = std::max(reached_, from_ + std::clamp(fraction, 0.0, 1.0) * (to_ - from_));
  }
  return !interrupted();
}

std::function<bool(double)> Progress::callback() {
  return [this](double fraction) { return at(fraction); };
}

void Progress::aside(const std::function<void()>& print) {
  const std::scoped_lock lock(mutex_);
  wipe();
  print();
}

void Progress::finish() {
  end(true);
}

void Progress::end(bool complete) {
  {
    const std::scoped_lock lock(mutex_);
    if (ended_) return;
    lap();
    ended_ = true;
    complete_ = complete;
  }
  wake_.notify_all();
  if (drawer_.joinable()) drawer_.join();
}

double Progress::seconds(std::string_view stage) const {
  const std::scoped_lock lock(mutex_);
  const std::size_t index = index_of(stage);
  return seconds_[index] + (index == stage_ ? now() : 0);
}

double Progress::build() const {
  const std::scoped_lock lock(mutex_);
  return (ended_ ? stage_start_ : spent()).build;
}

double Progress::run() const {
  const std::scoped_lock lock(mutex_);
  const Spent at = ended_ ? stage_start_ : spent();
  return at.seconds + at.build;
}

double Progress::done() const {
  return complete_ ? 1 : start_[stage_] + reached_ * (start_[stage_ + 1] - start_[stage_]);
}

std::string Progress::status() const {
  if (building_since_)
    return building_ + ", " + rounded(std::chrono::duration<double>(Clock::now() - *building_since_).count());
  std::string text = stages_[stage_].name;
  if (ended_) return text;
  constexpr double least = 0.02;  // fraction of a stage that says something about the rest
  const double stage_seconds = now();
  if (!note_.empty()) text += ", " + note_;
  if (reached_ < least) return text + (stage_seconds < 1 ? "" : ", " + rounded(stage_seconds));
  if (items_ > 0) text += ", " + rate_of(items_ * reached_ / stage_seconds, unit_);
  const double later =
      (1 - start_[stage_ + 1]) / (start_[stage_ + 1] - start_[stage_]);  // in times of this stage
  return text + ", " + rounded(stage_seconds / reached_ * (1 - reached_ + later)) + " left";
}

void Progress::draw() {
  const double fraction = done();
  const auto full = static_cast<std::size_t>(fraction * bar_width);
  std::string line = fmt::format("[{:=<{}}{: <{}}] {:3.0f} %  {}", "", full, "", bar_width - full,
                                 std::floor(100 * fraction), status());
  line.resize(std::min(line.size(), terminal_width() - 1));
  fmt::print(stderr, "\r{: <{}}", line, drawn_);
  std::fflush(stderr);
  drawn_ = std::max(drawn_, line.size());
}

void Progress::wipe() {
  if (drawn_ == 0) return;
  fmt::print(stderr, "\r{: <{}}\r", "", drawn_);
  std::fflush(stderr);
  drawn_ = 0;
}

void Progress::draw_from_time_to_time() {
  std::unique_lock lock(mutex_);
  const auto ended = [this] { return ended_; };
  bool drawn = false;
  for (auto wait = patience; !wake_.wait_for(lock, wait, ended); wait = period) {
    if (!kernel_builds().running)
      building_since_.reset();
    else if (!building_since_)
      building_since_ = Clock::now();
    draw();
    drawn = true;
  }
  building_since_.reset();
  if (drawn && complete_) draw();
  wipe();
}

double Approach::step(double share) {
  constexpr double least = 0.02;  // of what is left
  done_ += least * (1 - done_);
  if (share > done_) done_ = std::min(share, 1.0);
  return done_;
}

double logarithmic_share(double value, double first, double goal) {
  if (!(value > goal)) return 1;
  return std::log(first / value) / std::log(first / goal);
}

}  // namespace powercell::app
