/// \file
/// The density that --density or --image asks for.
#pragma once

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
  bool bright = false;  ///< light parts of the image are dense, instead of dark ones
};

void add_density_options(CLI::App& command, DensityArguments& arguments);

/// \throw WrongUsage for arguments that contradict each other
void check(const DensityArguments& arguments);

/// What the pixels of the image weigh: 0 to 1, rows from the top.
struct Ink {
  std::size_t width = 0, height = 0;
  std::vector<double> share;
};

/// \throw Error invalid_file (as read_image; nothing dark, or bright, in it)
Ink read_ink(const DensityArguments& arguments);

/// An image that fills the box of a domain. \param values  of the pixels of `ink`
/// \throw Error invalid_argument unless the domain is a polygon
Density image_density(const Domain& domain, const Ink& ink, std::span<const double> values);

/// "the integrals of the density are right to 1e-3 of a mass". \param quadrature_error  of TransportResult
std::string integrals_are_right_to(double quadrature_error);
/// What the user may do where that is not enough.
inline constexpr const char* remedy_of_integrals =
    "--density jumps or has kinks: give it as --image, which is exact, or a looser --tolerance";

/// By the arguments; 1 everywhere if there are none. \throw as the functions above and read_density
Density read_density(const DensityArguments& arguments, const Domain& domain);

}  // namespace powercell::app
