#include "apps/io/picture/frame.hpp"

#include <algorithm>
#include <cmath>

namespace powercell::io {

PictureFrame::PictureFrame(const PictureSize& size, const Legend& legend) : size_(size) {
  const double width = size.width, height = size.height > 0 ? size.height : size.width;
  legend_ = lay_out(legend, width, height);
  legend_.width = std::ceil(legend_.width);
  room_ = {width - legend_.width, height, size.height > 0};
}

double PictureFrame::long_side() const {
  return std::max(size_.width, size_.height);
}

void PictureFrame::place(double drawing_width, double drawing_height) {
  const bool exact = room_.exact;
  width_ = (exact ? room_.width : drawing_width) + legend_.width;
  height_ = exact ? room_.height : std::max(drawing_height, std::ceil(legend_.height));
  left_ = std::floor((width_ - legend_.width - drawing_width) / 2);
  top_ = std::floor((height_ - drawing_height) / 2);
  legend_.move(width_ - legend_.width, (height_ - legend_.height) / 2);
}

}  // namespace powercell::io
