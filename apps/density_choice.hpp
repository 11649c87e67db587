/// \file
/// The options --density and --image.
#pragma once

#include <array>
#include <powercell/powercell.hpp>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace powercell::app {

struct DensityArguments {
  std::string density, image;
  bool bright = false;  ///< the bright parts of the image are dense, instead of the dark ones
};

void add_density_options(CLI::App& command, DensityArguments& arguments);

/// \throw WrongUsage for arguments that contradict each other
void check(const DensityArguments& arguments);

/// Density of each pixel of an image, from 0 to 1, rows from the top.
struct Ink {
  std::size_t width = 0, height = 0;
  std::vector<double> share;
  /// Linear red, green and blue of the pixels; empty unless they were asked for.
  std::array<std::vector<float>, 3> channels;
};

/// \throw Error invalid_file as read_image, and for an image without dark (or bright) pixels
Ink read_ink(const DensityArguments& arguments, bool colours = false);

/// An image that fills the box of a domain.
/// \param values  of the pixels of `ink`, same shape
/// \throw Error invalid_argument unless the domain is a polygon
Density image_density(const Domain& domain, const Ink& ink, std::span<const double> values);

/// "the integrals of the density are right to 1e-3 of a mass".
/// \param quadrature_error  of TransportResult
std::string integrals_are_right_to(double quadrature_error);
/// Advice if that is not accurate enough.
inline constexpr const char* remedy_of_integrals =
    "--density jumps or has kinks: give it as --image, which is exact, or a looser --tolerance";

/// The density that the arguments give; 1 everywhere by default.
/// \throw as the functions above and read_density
Density read_density(const DensityArguments& arguments, const Domain& domain);

}  // namespace powercell::app
