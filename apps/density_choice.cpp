#include "apps/density_choice.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/common.hpp"
#include "apps/io/read/density.hpp"
#include "apps/io/read/image.hpp"

namespace powercell::app {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorCode::invalid_argument, what);
}

}  // namespace

void add_density_options(CLI::App& command, DensityArguments& arguments) {
  command
      .add_option("--density", arguments.density,
                  "Mass per unit of area or volume: a number, a formula in x, y and z, or a file "
                  "(.txt) with one value for each vertex of the mesh")
      ->type_name("FORMULA|FILE")
      ->default_str("1");
  command
      .add_option("--image", arguments.image,
                  "PNG or JPEG whose dark parts are dense; it fills the box of the domain")
      ->type_name("FILE")
      ->default_str("none");
  command.add_flag("--bright", arguments.bright, "The bright parts of the image are dense");
}

void check(const DensityArguments& arguments) {
  if (!arguments.density.empty() && !arguments.image.empty())
    throw WrongUsage("--density and --image cannot be combined");
  if (arguments.bright && arguments.image.empty()) throw WrongUsage("--bright needs an --image");
}

Ink read_ink(const DensityArguments& arguments, bool colours) {
  io::GrayImage image = io::read_image(arguments.image, colours);
  if (!arguments.bright)
    for (double& value : image.values) value = 1 - value;
  if (std::all_of(image.values.begin(), image.values.end(), [](double v) { return v == 0; }))
    throw Error(ErrorCode::invalid_file, fmt::format("{}: the image is blank, it has no {} pixels",
                                                     arguments.image, arguments.bright ? "bright" : "dark"));
  return {image.width, image.height, std::move(image.values), std::move(image.channels)};
}

Density image_density(const Domain& domain, const Ink& ink, std::span<const double> values) {
  if (domain.kind() != DomainKind::polygon)
    refuse("--image is a density of the plane: the domain must be a polygon");
  return Density::image({ink.width,
                         ink.height,
                         values,
                         {domain.low()[0], domain.low()[1]},
                         {domain.high()[0], domain.high()[1]}});
}

Density read_density(const DensityArguments& arguments, const Domain& domain) {
  check(arguments);
  if (!arguments.image.empty()) {
    const Ink ink = read_ink(arguments);
    return image_density(domain, ink, ink.share);
  }
  if (!arguments.density.empty()) return io::read_density(arguments.density, domain);
  return Density::constant(1);
}

std::string integrals_are_right_to(double quadrature_error) {
  return fmt::format("the integrals of the density are right to {:.1e} of a mass", quadrature_error);
}

}  // namespace powercell::app
