#include "lib/applications/density/pixels.hpp"

#include <algorithm>
#include <cmath>

#include "lib/applications/density/checked_values.hpp"

namespace powercell {
namespace {

const ImageView& checked(const ImageView& image) {
  const auto refuse = [](const std::string& why) { throw Error(ErrorCode::invalid_argument, why); };
  const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height);
  if (image.width == 0 || image.height == 0) refuse("an image of " + size + " pixels has no density");
  if (image.values.size() / image.width != image.height || image.values.size() % image.width != 0)
    refuse("an image of " + size + " pixels has " + std::to_string(image.values.size()) + " values");
  for (std::size_t k = 0; k < 2; ++k)
    if (!(image.low[k] < image.high[k]) || !std::isfinite(image.high[k] - image.low[k]))
      refuse("the rectangle of an image must have a width and a height, got " + std::to_string(image.low[k]) +
             " to " + std::to_string(image.high[k]));
  check_densities(image.values, "the image of " + size + " pixels is blank", [&](std::size_t k) {
    return "pixel " + std::to_string(k % image.width) + ", " + std::to_string(k / image.width) +
           " (from the top left)";
  });
  return image;
}

}  // namespace

Pixels::Pixels(const ImageView& image)
    : width_(static_cast<std::ptrdiff_t>(checked(image).width)),
      height_(static_cast<std::ptrdiff_t>(image.height)),
      low_(image.low),
      size_{(image.high[0] - image.low[0]) / static_cast<double>(image.width),
            (image.high[1] - image.low[1]) / static_cast<double>(image.height)} {
  value_.reserve(image.values.size());
  before_.reserve(image.values.size() + image.height);
  for (std::ptrdiff_t row = height_ - 1; row >= 0; --row) {
    Sums sum;
    before_.push_back(sum);
    for (std::ptrdiff_t c = 0; c < width_; ++c) {
      const double value = image.values[static_cast<std::size_t>(row * width_ + c)];
      const auto column = static_cast<double>(c);
      value_.push_back(value);
      sum.zeroth += value;
      sum.first += value * (column + 0.5);
      sum.second += value * (column * (column + 1) + 1.0 / 3);
      before_.push_back(sum);
    }
  }
}

double Pixels::value(std::ptrdiff_t row, std::ptrdiff_t column) const {
  const bool inside = row >= 0 && row < height_ && column >= 0 && column < width_;
  return inside ? value_[static_cast<std::size_t>(row * width_ + column)] : 0;
}

Pixels::Sums Pixels::sums(std::ptrdiff_t row, std::ptrdiff_t column, double u) const {
  if (row < 0 || row >= height_ || column < 0) return {};
  const Sums* const line = &before_[static_cast<std::size_t>(row * (width_ + 1))];
  if (column >= width_) return line[width_];
  const double value = value_[static_cast<std::size_t>(row * width_ + column)];
  const auto c = static_cast<double>(column);
  const Sums& before = line[column];
  return {before.zeroth + value * (u - c), before.first + value * (u - c) * (u + c) / 2,
          before.second + value * (u - c) * (u * u + u * c + c * c) / 3};
}

}  // namespace powercell
