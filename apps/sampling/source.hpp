/// \file
/// The domain and the density of `powercell sample`, from its arguments.
#pragma once

#include <optional>
#include <powercell/powercell.hpp>
#include <string>
#include <vector>

#include "apps/density_choice.hpp"
#include "apps/domain_choice.hpp"
#include "apps/io/picture/palette.hpp"

namespace powercell::app {

struct SourceArguments : DomainArguments, DensityArguments {
  double dot_contrast = 0.3;  ///< share of the darkness shown by the sizes of dots instead of their number
  bool color = false;         ///< dots have the colours of the image
  int paper = 0;              ///< 2 or 3 for the experiment of the paper in that dimension
};

struct Source {
  Domain domain;
  std::string description;
  Density density;  ///< of the points
  /// For an image: the share of the paper to be covered with ink, 0 to 1.
  std::optional<Density> ink;
  Ink image;  ///< with its channels, for coloured dots; else empty
};

/// \throw Error invalid_argument (arguments that contradict each other), as the readers
Source read_source(const SourceArguments& arguments);

/// Radii of dots. For an image the ink in each cell equals that of the image there; else all radii are equal.
std::vector<double> dot_radii(const Device& device, const Source& source, const SamplingResult& points);

/// The mean colour of the inked parts of the image in each cell.
/// \pre source.image has channels
std::vector<io::Colour> dot_colours(const Device& device, const Source& source, const SamplingResult& points);

}  // namespace powercell::app
