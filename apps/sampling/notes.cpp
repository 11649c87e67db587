#include "apps/sampling/notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/common.hpp"

namespace powercell::app {
namespace {

constexpr double negligible = 0.01;  // of the domain
// Cells of points this many times as near to each other as two sides hardly reach from one to the other:
// measured on plates.
constexpr double enough = 0.75;
constexpr std::size_t most_named = 6;  // layers

/// "some 57,000", to two digits, or "many": points whose cells would end before the parts that are apart.
std::string enough_points(const Domain& domain, const SamplingResult& points) {
  const double wanted = domain.measure() * std::pow(enough / points.apart.distance, domain.cell_dimension());
  if (!(wanted < 1e9)) return "many";
  const double more = 1.1 * static_cast<double>(points.weights.size());
  const double count = std::max(wanted, more), unit = std::pow(10, std::floor(std::log10(count)) - 1);
  return "some " + with_commas(static_cast<std::size_t>(std::ceil(count / unit) * unit));
}

std::string counts_of(const std::vector<std::size_t>& layers) {
  if (layers.size() > most_named) {
    const auto [least, most] = std::ranges::minmax(layers);
    return fmt::format("{} to {} points on each", with_commas(least), with_commas(most));
  }
  std::vector<std::string> counts;
  for (const std::size_t n : layers) counts.push_back(with_commas(n));
  return fmt::format("{} points", fmt::join(counts, " + "));
}

std::string note_of_layers(const Domain& domain, const SamplingResult& points) {
  return fmt::format(
      "sides of the surface are nearer to each other than the points, which are spread on {} layers instead, "
      "{}; {:.0f} % of the area lies in power cells of points on another layer; {} points would be nearer to "
      "each other than the sides",
      points.layers.size(), counts_of(points.layers), 100 * points.apart.share,
      enough_points(domain, points));
}

std::string note_of_parts(const Domain& domain, const SamplingResult& points, bool blue) {
  return fmt::format(
      "{:.0f} % of the {} lies in parts of {} cells that are apart from their points, beyond a gap or on the "
      "other side of a thin wall, and has fewer points than its share; {}use more, {}",
      100 * points.apart.share, domain.cell_dimension() == 3 ? "volume" : "area",
      with_commas(points.apart.cells),
      domain.kind() == DomainKind::surface && !blue ? "use --mode blue, which gives each side its share, or "
                                                    : "",
      enough_points(domain, points));
}

}  // namespace

std::vector<std::string> notes_of(const Domain& domain, const Study& study, SamplingMode mode) {
  const SamplingResult& points =
      std::ranges::max_element(study.runs, {}, [](const Run& run) { return run.points.apart.share; })->points;
  if (!points.layers.empty()) return {note_of_layers(domain, points)};
  if (points.apart.share > negligible) return {note_of_parts(domain, points, mode == SamplingMode::blue)};
  return {};
}

}  // namespace powercell::app
