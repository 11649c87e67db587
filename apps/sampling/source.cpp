#include "apps/sampling/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/common.hpp"
#include "apps/georeference.hpp"
#include "apps/io/maps/crs.hpp"
#include "apps/io/names.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/domain.hpp"

namespace powercell::app {
namespace {

/// The density of Xiao et al. 2023, on the box from -1 to 1.
Source paper_source(int dimension) {
  const std::vector<double> low(static_cast<std::size_t>(dimension), -1), high(low.size(), 1);
  return {Domain::box(low, high),
          fmt::format("the box from -1 to 1 in {} dimensions", dimension),
          Density::formula(dimension == 2 ? "1/(x^2+y^2+0.1)" : "1/(x^2+y^2+z^2+0.1)"),
          std::nullopt,
          {}};
}

/// The description of a domain; of a map in degrees with a warning, since sampling does not project, and of a
/// mesh with what it may have been meant to be.
std::string description_of(const io::LoadedDomain& domain, const DomainArguments& chosen) {
  if (domain.domain.kind() == DomainKind::surface && chosen.kind.empty() &&
      !io::is_builtin_domain(chosen.domain))
    return domain.description + "; points lie on it (--solid takes its inside)";
  if (!io::is_in_degrees(domain.crs.name)) return domain.description;
  return domain.description +
         fmt::format(
             "\nmap: {} is sampled as a plane of degrees; project the file for points that are "
             "evenly spaced on the ground",
             io::readable(domain.crs.name));
}

Source image_source(const SourceArguments& arguments) {
  Ink ink = read_ink(arguments, arguments.color);
  std::string description = fmt::format("{}: {} x {} pixels", arguments.image, ink.width, ink.height);
  std::optional<Domain> domain;
  if (!arguments.domain.empty()) {
    io::LoadedDomain loaded = io::load_domain(read_domain_arrays(arguments), arguments.domain);
    domain = loaded.domain;
    description += ", over " + description_of(loaded, arguments);
  } else {
    const std::array<double, 2> low{0, 0};
    domain = Domain::box(low, std::array{static_cast<double>(ink.width), static_cast<double>(ink.height)});
  }
  std::vector<double> points(ink.share.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k] = std::pow(ink.share[k], 1 - arguments.dot_contrast);
  Source source{
      *domain, description, image_density(*domain, ink, points), image_density(*domain, ink, ink.share), {}};
  if (arguments.color) source.image = std::move(ink);
  return source;
}

}  // namespace

Source read_source(const SourceArguments& arguments) {
  check(arguments);
  if (arguments.paper != 0) {
    if (!(arguments.density + arguments.image + arguments.domain + arguments.periodic).empty())
      throw Error(ErrorCode::invalid_argument,
                  "--paper cannot be combined with --domain, --density, --image or --periodic");
    return paper_source(arguments.paper);
  }
  if (!arguments.image.empty()) {
    if (!arguments.periodic.empty())
      throw Error(ErrorCode::unsupported,
                  "--periodic: in a periodic domain the density must be constant; leave "
                  "out --image or --periodic");
    return image_source(arguments);
  }
  DomainArguments chosen = arguments;
  if (chosen.domain.empty()) chosen.domain = "square";
  const io::LoadedDomain loaded = io::load_domain(read_domain_arrays(chosen), chosen.domain);
  return {loaded.domain,
          description_of(loaded, chosen),
          read_density(arguments, loaded.domain),
          std::nullopt,
          {}};
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
  // Equal dots that leave gaps even where the points are densest, the densest twentieth excepted.
  std::vector<double> areas = diagram.measures().mass;
  const auto at = areas.begin() + static_cast<std::ptrdiff_t>(n / 20);
  std::nth_element(areas.begin(), at, areas.end());
  return std::vector<double>(n, 0.3 * std::sqrt(*at));
}

std::vector<io::Colour> dot_colours(const Device& device, const Source& source,
                                    const SamplingResult& points) {
  const std::size_t n = points.weights.size();
  Diagram diagram(device, source.domain);
  diagram.set_seeds({2, points.positions, points.weights});
  const std::vector<double> ink = integrate(diagram, *source.ink, false).mass;
  std::array<std::vector<double>, 3> light;
  std::vector<double> values(source.image.share.size());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = source.image.share[k] * static_cast<double>(source.image.channels[c][k]);
    light[c].assign(n, 0);
    if (std::ranges::all_of(values, [](double value) { return value == 0; })) continue;  // no density
    light[c] = integrate(diagram, image_density(source.domain, source.image, values), false).mass;
  }
  std::vector<io::Colour> colours(n);
  for (std::size_t i = 0; i < n; ++i)
    if (ink[i] > 0)
      colours[i] = {io::to_srgb(light[0][i] / ink[i]), io::to_srgb(light[1][i] / ink[i]),
                    io::to_srgb(light[2][i] / ink[i])};
  return colours;
}

}  // namespace powercell::app
