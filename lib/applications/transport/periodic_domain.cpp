#include "lib/applications/transport/periodic_domain.hpp"

#include <powercell/regions.hpp>
#include <span>

namespace powercell {
namespace {

bool is_box(const Domain& domain) {
  if (domain.region_count() != 1) return false;
  if (domain.kind() == DomainKind::volume) return domain.regions().shape == RegionShape::box;
  const std::array<double, 3> low = domain.low(), high = domain.high();
  return domain.kind() == DomainKind::polygon &&
         domain.measure() >= (1 - 1e-12) * (high[0] - low[0]) * (high[1] - low[1]);
}

}  // namespace

Domain periodic_domain(Domain domain, bool periodic) {
  if (!periodic || domain.is_periodic()) return domain;
  if (!is_box(domain))
    throw Error(ErrorCode::unsupported,
                "only a box can be periodic; use Domain::box, or Domain::lattice for a skew one");
  const auto d = static_cast<std::size_t>(domain.dimension());
  const std::array<double, 3> low = domain.low(), high = domain.high();
  return Domain::periodic_box(std::span(low).first(d), std::span(high).first(d));
}

}  // namespace powercell
