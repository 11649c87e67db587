#include <cmath>
#include <numbers>
#include <powercell/point_sets.hpp>
#include <string>

#include "lib/base/float_environment.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

/// exp(-2 pi i k t) for k = 0 .. highest, as real and imaginary parts.
struct Waves {
  std::vector<double> re, im;
  void set(double t, int highest) {
    re.resize(static_cast<std::size_t>(highest) + 1);
    im.resize(re.size());
    for (std::size_t k = 0; k < re.size(); ++k) {
      // Whole turns are subtracted first, which keeps the argument of sine and cosine small and accurate.
      const double turns = static_cast<double>(k) * t;
      const double angle = -2 * std::numbers::pi * (turns - std::floor(turns));
      re[k] = std::cos(angle);
      im[k] = std::sin(angle);
    }
  }
};

/// Sums over points for f_x = 0 .. F and f_y = -F .. F. Those for -f_x are complex conjugates.
struct Sums {
  std::size_t columns, rows;
  std::vector<double> re, im;
  explicit Sums(int highest)
      : columns(static_cast<std::size_t>(highest) + 1),
        rows(2 * static_cast<std::size_t>(highest) + 1),
        re(rows * columns),
        im(re.size()) {}
  void add(const Waves& x, const Waves& y) {
    const std::size_t highest = columns - 1;
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t k = row < highest ? highest - row : row - highest;
      const double a = y.re[k], b = row < highest ? -y.im[k] : y.im[k];
      double* const to_re = &re[row * columns];
      double* const to_im = &im[row * columns];
      for (std::size_t c = 0; c < columns; ++c) {
        to_re[c] += a * x.re[c] - b * x.im[c];
        to_im[c] += a * x.im[c] + b * x.re[c];
      }
    }
  }
};

// The points are summed in this many shares, in a fixed order for any number of threads.
constexpr std::size_t shares = 8;

}  // namespace

Spectrum spectrum(const Domain& box, std::span<const double> positions, int highest, int threads) {
  const FloatEnvironment environment;
  if (box.dimension() != 2)
    throw Error(ErrorCode::unsupported, "spectra are computed in boxes of the plane only");
  const std::size_t n = positions.size() / 2;
  if (n == 0 || positions.size() % 2 != 0 || highest < 0)
    throw Error(ErrorCode::invalid_argument, "a spectrum needs points with two coordinates each");
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (!std::isfinite(positions[k]))
      throw Error(ErrorCode::invalid_seed, "point " + std::to_string(k / 2) + " of a spectrum is not finite");
  Spectrum result;
  result.points = n;
  result.highest = highest > 0 ? highest : static_cast<int>(std::ceil(2 * std::sqrt(static_cast<double>(n))));
  std::vector<Sums> sums(shares, Sums(result.highest));
  const auto low = box.low(), high = box.high();
  parallel_tasks(thread_count(threads), shares, [&](int, std::size_t share) {
    Waves x, y;
    for (std::size_t i = n * share / shares; i < n * (share + 1) / shares; ++i) {
      x.set((positions[2 * i] - low[0]) / (high[0] - low[0]), result.highest);
      y.set((positions[2 * i + 1] - low[1]) / (high[1] - low[1]), result.highest);
      sums[share].add(x, y);
    }
  });
  const std::size_t rows = sums[0].rows, columns = sums[0].columns;
  result.power.resize(rows * rows);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t c = 0; c < columns; ++c) {
      double re = 0, im = 0;
      for (const Sums& part : sums) {
        re += part.re[row * columns + c];
        im += part.im[row * columns + c];
      }
      const double power = (re * re + im * im) / static_cast<double>(n);
      result.power[row * rows + columns - 1 + c] = power;
      result.power[(rows - 1 - row) * rows + columns - 1 - c] = power;
    }
  return result;
}

Spectrum mean(std::span<const Spectrum> spectra) {
  const FloatEnvironment environment;
  if (spectra.empty()) throw Error(ErrorCode::invalid_argument, "no spectra to take the mean of");
  Spectrum result = spectra.front();
  result.power.assign(result.power.size(), 0.0);
  result.runs = 0;
  for (const Spectrum& one : spectra) {
    if (one.power.size() != result.power.size() || one.points != result.points)
      throw Error(ErrorCode::invalid_argument, "spectra of different sizes have no mean");
    for (std::size_t k = 0; k < result.power.size(); ++k)
      result.power[k] += one.power[k] * static_cast<double>(one.runs);
    result.runs += one.runs;
  }
  for (double& p : result.power) p /= static_cast<double>(result.runs);
  return result;
}

Spectrum::Radial Spectrum::radial() const {
  const int side = 2 * highest + 1;
  const auto rings = static_cast<std::size_t>(highest) + 1;
  std::vector<double> count(rings), sum(rings), squares(rings);
  for (int pass = 0; pass < 2; ++pass)
    for (int row = 0; row < side; ++row)
      for (int c = 0; c < side; ++c) {
        const auto ring = static_cast<std::size_t>(std::lround(std::hypot(row - highest, c - highest)));
        if (ring == 0 || ring >= rings) continue;
        const double p = power[static_cast<std::size_t>(row * side + c)];
        if (pass == 0) {
          count[ring] += 1;
          sum[ring] += p;
        } else {
          const double off = p - sum[ring] / count[ring];
          squares[ring] += off * off;
        }
      }
  Radial result;
  for (std::size_t k = 1; k < rings; ++k) {
    const double mean = sum[k] / count[k];
    result.mean.push_back(mean);
    // f and -f have the same power, so only half the values are independent.
    result.anisotropy.push_back(mean > 0 ? squares[k] / (count[k] - 2) / (mean * mean) : 0);
  }
  return result;
}

double Spectrum::low_frequency(double fraction) const {
  const double limit = fraction * std::sqrt(static_cast<double>(points));
  const int side = 2 * highest + 1;
  double sum = 0, count = 0;
  for (int row = 0; row < side; ++row)
    for (int c = 0; c < side; ++c) {
      const double f = std::hypot(row - highest, c - highest);
      if (f == 0 || f > limit) continue;
      sum += power[static_cast<std::size_t>(row * side + c)];
      count += 1;
    }
  return count > 0 ? sum / count : 0;
}

}  // namespace powercell
