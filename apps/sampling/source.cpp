#include "apps/sampling/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/common.hpp"
#include "apps/io/read_density.hpp"
#include "apps/io/read_domain.hpp"
#include "apps/io/read_image.hpp"

namespace powercell::app {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorCode::invalid_argument, what);
}

/// The density of Xiao et al. 2023, on the box from -1 to 1.
Source paper_source(int dimension) {
  const std::vector<double> low(static_cast<std::size_t>(dimension), -1), high(low.size(), 1);
  return {Domain::box(low, high), fmt::format("the box from -1 to 1 in {} dimensions", dimension),
          Density::formula(dimension == 2 ? "1/(x^2+y^2+0.1)" : "1/(x^2+y^2+z^2+0.1)"), std::nullopt};
}

Source image_source(const SourceArguments& arguments) {
  const io::GrayImage image = io::read_image(arguments.image);
  std::array<double, 2> low{0, 0};
  std::array<double, 2> high{static_cast<double>(image.width), static_cast<double>(image.height)};
  std::optional<Domain> domain;
  std::string description = fmt::format("{}: {} x {} pixels", arguments.image, image.width, image.height);
  if (!arguments.domain.empty()) {
    io::LoadedDomain loaded = io::read_domain(arguments.domain, domain_kind(arguments.kind));
    if (loaded.domain.kind() != DomainKind::polygon)
      refuse("--image is a density of the plane: the domain must be a polygon");
    low = {loaded.domain.low()[0], loaded.domain.low()[1]};
    high = {loaded.domain.high()[0], loaded.domain.high()[1]};
    domain = loaded.domain;
    description += ", over " + loaded.description;
  } else {
    domain = Domain::box(low, high);
  }
  std::vector<double> ink(image.values.size()), density(ink.size());
  for (std::size_t k = 0; k < ink.size(); ++k) {
    ink[k] = arguments.bright ? image.values[k] : 1 - image.values[k];
    density[k] = std::pow(ink[k], 1 - arguments.dot_contrast);
  }
  if (std::all_of(ink.begin(), ink.end(), [](double v) { return v == 0; }))
    throw Error(ErrorCode::invalid_file,
                fmt::format("{}: the image is blank, there is nothing {} in it to sample", arguments.image,
                            arguments.bright ? "bright" : "dark"));
  const auto view = [&](const std::vector<double>& values) {
    return ImageView{image.width, image.height, values, low, high};
  };
  return {*domain, description, Density::image(view(density)), Density::image(view(ink))};
}

void check(const SourceArguments& arguments) {
  if (!arguments.density.empty() && !arguments.image.empty())
    refuse("--density and --image exclude each other");
  if (arguments.paper != 0 && !(arguments.density + arguments.image + arguments.domain).empty())
    refuse("--paper has a domain and a density of its own");
  if (arguments.bright && arguments.image.empty()) refuse("--bright needs an --image");
}

}  // namespace

Source read_source(const SourceArguments& arguments) {
  check(arguments);
  if (arguments.paper != 0) return paper_source(arguments.paper);
  if (!arguments.image.empty()) return image_source(arguments);
  const std::string spec = arguments.domain.empty() ? "square" : arguments.domain;
  const io::LoadedDomain loaded = io::read_domain(spec, domain_kind(arguments.kind));
  Density density = Density::constant(1);
  if (!arguments.density.empty()) density = io::read_density(arguments.density, loaded.domain);
  return {loaded.domain, loaded.description, density, std::nullopt};
}

std::vector<double> dot_radii(const Device& device, const Source& source, const SamplingResult& points) {
  const std::size_t n = points.weights.size();
  if (!source.ink) {
    const double spacing = std::sqrt(source.domain.measure() / static_cast<double>(n));
    if (source.density.is_constant()) return std::vector<double>(n, 0.25 * spacing);
  }
  Diagram diagram(device, source.domain);
  diagram.set_seeds({2, points.positions, points.weights});
  if (source.ink) {
    std::vector<double> radii = integrate(diagram, *source.ink, false).mass;
    for (double& r : radii) r = std::sqrt(std::max(r, 0.0) / std::acos(-1.0));
    return radii;
  }
  // Equal dots that leave room between them where the points are densest, but for the densest twentieth.
  std::vector<double> areas = diagram.measures().mass;
  const auto at = areas.begin() + static_cast<std::ptrdiff_t>(n / 20);
  std::nth_element(areas.begin(), at, areas.end());
  return std::vector<double>(n, 0.3 * std::sqrt(*at));
}

}  // namespace powercell::app
