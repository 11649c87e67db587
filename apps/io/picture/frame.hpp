/// \file
/// How a picture is divided: the drawing, and the legend at its right.
#pragma once

#include "apps/io/picture/legend.hpp"
#include "apps/io/picture/style.hpp"

namespace powercell::io {

/// The part of a picture for the drawing, in pixels.
struct PictureRoom {
  double width = 0, height = 0;
  bool exact = false;  ///< the picture has just this size, else at most this
};

class PictureFrame {
 public:
  PictureFrame(const PictureSize& size, const Legend& legend);

  const PictureRoom& room() const { return room_; }
  /// How much larger than the usual picture this one is; lines grow with it.
  double enlargement() const { return long_side() / 1600; }
  double long_side() const;

  /// Takes the drawing, at most as large as its room, and puts it and the legend in their places.
  void place(double drawing_width, double drawing_height);
  // Of the whole picture, after `place`.
  double width() const { return width_; }
  double height() const { return height_; }
  double left() const { return left_; }  ///< of the drawing
  double top() const { return top_; }
  const LegendScene& legend() const { return legend_; }

 private:
  PictureSize size_;
  LegendScene legend_;
  PictureRoom room_;
  double width_ = 0, height_ = 0, left_ = 0, top_ = 0;
};

}  // namespace powercell::io
