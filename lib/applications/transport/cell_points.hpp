/// \file
/// Points that stand for the cells of a diagram.
#pragma once

#include <powercell/domain.hpp>
#include <vector>

#include "lib/applications/linear/laplacian.hpp"
#include "lib/applications/transport/soft_transport.hpp"

namespace powercell {

/// Points of the domain in the cells of seeds, as vectors from the seed; in a periodic domain from the image
/// whose cell the point is in.
/// \param positions  n x d
/// \param count      of all points, about
std::vector<Weighted> cell_points(const Domain& domain, const std::vector<double>& positions,
                                  const Vector& weights, std::size_t count);

}  // namespace powercell
