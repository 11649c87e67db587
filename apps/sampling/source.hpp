/// \file
/// What `powercell sample` samples: the domain and the density, from its arguments.
#pragma once

#include <optional>
#include <powercell/powercell.hpp>
#include <string>
#include <vector>

#include "apps/density_choice.hpp"

namespace powercell::app {

struct SourceArguments : DensityArguments {
  std::string domain, kind;
  double dot_contrast = 0.3;  ///< share of the darkness that dot sizes show, instead of their number
  int paper = 0;              ///< 2 or 3: the experiment of the paper in that dimension
};

struct Source {
  Domain domain;
  std::string description;
  Density density;  ///< of the points
  /// Image: the part of the paper that ink is to cover, 0 to 1. Else nothing.
  std::optional<Density> ink;
};

/// \throw Error invalid_argument (arguments that contradict each other), as the readers
Source read_source(const SourceArguments& arguments);

/// Radii of dots: for an image such that the ink in each cell is what the image has there, else equal ones.
/// \param weights  those of the cells of equal mass
std::vector<double> dot_radii(const Device& device, const Source& source, const SamplingResult& points);

}  // namespace powercell::app
