/// \file
/// How pictures show a diagram.
#pragma once

#include <powercell/seeds.hpp>
#include <string>
#include <vector>

#include "apps/io/picture/vector.hpp"
#include "apps/io/tables/kept_columns.hpp"

namespace powercell::io {

/// What the colours of cells show.
struct ColourBy {
  enum class What { hues, measure, weight, neighbors, column };
  What what = What::hues;  ///< hues tell neighbours apart and mean nothing
  KeptColumn column{};     ///< of the seeds' table, whose rows are the seeds
};

/// In pixels, or in points for pages.
struct PictureSize {
  int width = 1600;     ///< or the longer side
  int height = 0;       ///< 0: as the shape needs it
  bool points = false;  ///< a page has this size in points, not in pixels of 1/96 inch
};

struct PictureStyle {
  ColourBy colours{};
  bool legend = true;  ///< if colours mean something
  PictureSize size{};
  Vec3 towards{0.60f, -0.80f, 0.52f};  ///< from a surface or volume to the camera
  Vec3 up{0, 0, 1};                    ///< shown upwards; not parallel to `towards`
  bool cut = true;                     ///< volumes are opened towards the camera
};

/// "measure", "weight", "neighbors", or a column of the seeds' table, as results with that table call it.
/// \throw Error invalid_argument for another name, listing those that there are, and for a column of more
/// texts than can be told apart
ColourBy colour_by(const std::string& name, const InputView& inputs, const SeedsView& seeds);

}  // namespace powercell::io
