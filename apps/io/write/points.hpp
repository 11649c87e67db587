/// \file
/// Points as tables and as pictures of dots.
#pragma once

#include <powercell/domain.hpp>
#include <span>
#include <string>
#include <string_view>

#include "apps/io/picture/palette.hpp"
#include "apps/io/picture/style.hpp"

namespace powercell::io {

/// n points; nothing is owned.
struct PointOutput {
  const Domain& domain;
  std::span<const double> positions;  ///< n x d, row-major
  std::span<const double> weights;    ///< n
  std::span<const double> mass;       ///< n
  std::span<const double> radii;      ///< n, of the dots, length; only pictures need them
  PictureSize size = {};
  std::span<const Colour> colours = {};  ///< n, of the dots; or none: ink
  bool dark_paper = false;
};

inline constexpr std::string_view point_outputs = ".svg .png .pdf .csv .txt";

/// \throw Error invalid_file (unknown extension)
void check_points_format(const std::string& path);

/// Checks before a long computation that `write_points` accepts the file.
/// \throw Error invalid_file (unknown extension), unsupported (a picture of points in space)
void check_points(const std::string& path, const Domain& domain);

/// CSV `x,y[,z],weight,mass` (.csv), with `r,g,b` from 0 to 255 if the dots have colours, rows `x y [z] w` as
/// `--seeds` takes them (.txt), or a picture of black or coloured dots on white or dark paper (.svg .png
/// .pdf), the domain's box, by default 1600 pixels on its long side.
/// \throw Error as check_points; write_failed
void write_points(const std::string& path, const PointOutput& output);

}  // namespace powercell::io
