#include "lib/domain/measure.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "lib/base/mesh_arrays.hpp"
#include "lib/base/text.hpp"

namespace powercell {

void finish(RegionMesh& mesh, const CompensatedSum<long double>& measure) {
  const auto dimension = static_cast<std::size_t>(mesh.dimension);
  double largest = 0;
  for (std::size_t k = 0; k < dimension; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::uint32_t v : mesh.region_vertex) {
      low = std::min(low, mesh.vertices[v * dimension + k]);
      high = std::max(high, mesh.vertices[v * dimension + k]);
    }
    mesh.low[k] = low;
    mesh.high[k] = high;
    largest = std::max({largest, std::abs(low), std::abs(high)});
  }
  check_magnitude(largest);
  mesh.measure = measure.value();
  if (!std::isfinite(mesh.measure) || mesh.measure <= 0) {
    throw Error(ErrorCode::invalid_domain,
                std::string("the ") + (mesh.cell_dimension == 3 ? "volume" : "area") + " of the domain is " +
                    digits(mesh.measure) + " in double precision; scale the coordinates to a moderate size");
  }
}

}  // namespace powercell
