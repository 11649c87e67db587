#include "lib/applications/density/checked_values.hpp"

#include <algorithm>
#include <powercell/regions.hpp>

#include "lib/base/text.hpp"

namespace powercell {
namespace {

// Fractions of the way to the middle of the region that are tried. Vertices lie beyond the boundary by some
// last places of their coordinates; by more if their seeds are far away or the region is a needle.
constexpr double inwards[] = {0x1p-45, 0x1p-30};

/// The mean of the vertices of a region.
Point middle_of(const RegionsView& mesh, std::uint32_t region) {
  const auto d = static_cast<std::size_t>(mesh.dimension);
  const std::uint32_t begin = mesh.region_offset[region], end = mesh.region_offset[region + 1];
  Point middle{};
  for (std::uint32_t v = begin; v < end; ++v)
    for (std::size_t k = 0; k < d; ++k)
      middle[k] += mesh.vertices[mesh.region_vertex[v] * d + k] / static_cast<double>(end - begin);
  return middle;
}

}  // namespace

void refuse_density(double value, const std::string& where) {
  throw Error(ErrorCode::invalid_argument, "the density is " + digits(value) + " at " + where +
                                               "; it must be between 0 and " +
                                               digits(Density::largest_value));
}

void CheckedSource::evaluate(std::span<const Point> x, std::uint32_t region, std::span<double> values) {
  evaluate_unchecked(x, values);
  for (std::size_t k = 0; k < x.size(); ++k)
    if (!is_density(values[k])) values[k] = evaluate_inwards(x[k], region, values[k]);
}

double CheckedSource::evaluate_inwards(const Point& x, std::uint32_t region, double value) {
  if (region != region_) {
    middle_ = middle_of(domain_.regions(), region);
    region_ = region;
  }
  const bool too_large = value > Density::largest_value;  // an error at the boundary too
  for (const double part : inwards) {
    if (too_large) break;
    Point nearer{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double in_box = std::clamp(x[k], domain_.low()[k], domain_.high()[k]);
      nearer[k] = in_box + part * (middle_[k] - in_box);
    }
    double found = 0;
    evaluate_unchecked({&nearer, 1}, {&found, 1});
    if (is_density(found)) return found;
  }
  refuse_density(value, "x = " + digits(x[0]) + ", y = " + digits(x[1]) + ", z = " + digits(x[2]));
}

}  // namespace powercell
