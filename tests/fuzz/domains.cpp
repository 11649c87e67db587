// Every way to make a domain, from any arrays.
#include <cmath>

#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

double ring_area(const Ring& ring) {
  long double twice = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k)
    twice += (static_cast<long double>(ring[k][0]) - ring[0][0]) * (ring[k + 1][1] - ring[0][1]) -
             (static_cast<long double>(ring[k][1]) - ring[0][1]) * (ring[k + 1][0] - ring[0][0]);
  return static_cast<double>(std::fabs(twice) / 2);
}

/// A polygon's area by the shoelace formula of its rings. Of one far longer than wide rounding takes more: a
/// last place of its length, times its length.
void check_area(const std::vector<PolygonPart>& parts, double length, double measure) {
  double area = 0, all = 0;
  for (const PolygonPart& part : parts) {
    all += ring_area(part.outer);
    area += ring_area(part.outer);
    for (const Ring& hole : part.holes) {
      all += ring_area(hole);
      area -= ring_area(hole);
    }
  }
  require(std::fabs(area - measure) <= 1e-12 * all + 0x1p-50 * length * length,
          "a polygon's measure is not the area of its rings");
}

}  // namespace

void domains(Bytes bytes) {
  Input input(bytes);
  const DomainInput arrays = any_domain(input);
  accepted({ErrorCode::invalid_domain}, [&] {
    const Domain domain = make(arrays);
    const auto low = domain.low(), high = domain.high();
    require(std::isfinite(domain.measure()) && domain.measure() > 0, "a domain of no or infinite measure");
    require(domain.region_count() > 0, "a domain without regions");
    for (std::size_t k = 0; k < 3; ++k)
      require(std::isfinite(low[k]) && std::isfinite(high[k]) && low[k] <= high[k], "no bounding box");
    if (arrays.kind == DomainInput::Kind::polygon)
      check_area(arrays.parts, std::hypot(high[0] - low[0], high[1] - low[1]), domain.measure());
    if (arrays.kind == DomainInput::Kind::surface || arrays.kind == DomainInput::Kind::volume)
      require(domain.region_count() <= arrays.elements.size() / (domain.cell_dimension() + 1u),
              "more regions than elements");
  });
}

}  // namespace powercell::fuzz
