/// \file
/// The pixels of an image with prefix sums along their rows.
#pragma once

#include <powercell/density.hpp>
#include <vector>

namespace powercell {

/// An image in pixel coordinates: pixel (c, r) is the square [c, c+1] x [r, r+1], with rows from the bottom
/// up. The density is 0 outside.
class Pixels {
 public:
  explicit Pixels(const ImageView& image);

  /// Integrals of rho, rho t and rho t² over t from 0 to u along a row: R_k of (33).
  struct Sums {
    double zeroth = 0, first = 0, second = 0;
  };
  /// \param column  the column that contains u, or has it on its border
  Sums sums(std::ptrdiff_t row, std::ptrdiff_t column, double u) const;
  double value(std::ptrdiff_t row, std::ptrdiff_t column) const;

  double width() const { return static_cast<double>(width_); }
  double height() const { return static_cast<double>(height_); }
  std::array<double, 2> pixels(double x, double y) const {
    return {(x - low_[0]) / size_[0], (y - low_[1]) / size_[1]};
  }
  /// Width and height of a pixel, in the unit of the domain.
  const std::array<double, 2>& size() const { return size_; }

 private:
  std::ptrdiff_t width_, height_;
  std::array<double, 2> low_, size_;
  std::vector<double> value_;  // height x width, from the bottom up
  std::vector<Sums> before_;   // height x (width + 1): sums up to the left border of each column
};

}  // namespace powercell
