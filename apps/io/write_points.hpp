/// \file
/// Points as tables and as pictures of dots.
#pragma once

#include <powercell/domain.hpp>
#include <span>
#include <string>
#include <string_view>

#include "apps/io/picture_style.hpp"

namespace powercell::io {

/// n points; nothing is owned.
struct PointOutput {
  const Domain& domain;
  std::span<const double> positions;  ///< n x d, row-major
  std::span<const double> weights;    ///< n
  std::span<const double> mass;       ///< n
  std::span<const double> radii;      ///< n, of the dots, length; only pictures need them
  PictureSize size = {};
};

inline constexpr std::string_view point_outputs = ".svg .png .pdf .csv .txt";

/// \throw Error invalid_file (unknown extension)
void check_points_format(const std::string& path);

/// Checks before a long computation that `write_points` accepts the file. \throw Error invalid_file (unknown
/// extension), unsupported (a picture of points in space)
void check_points(const std::string& path, const Domain& domain);

/// CSV `x,y[,z],weight,mass` (.csv), rows `x y [z] w` as `--seeds` takes them (.txt), or a picture of black
/// dots on white paper (.svg .png .pdf), the domain's box, by default 1600 pixels on its long side. \throw
/// Error as check_points; write_failed
void write_points(const std::string& path, const PointOutput& output);

}  // namespace powercell::io
