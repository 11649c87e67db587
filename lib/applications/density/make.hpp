/// \file
/// The kinds of densities there are. Each throws as the function of Density of its name. Internal.
#pragma once

#include "lib/applications/density/model.hpp"

namespace powercell {

using DensityModelPtr = std::shared_ptr<const DensityModel>;

DensityModelPtr make_formula(std::string_view expression, double tolerance);
DensityModelPtr make_function(std::function<double(const std::array<double, 3>&)> value, double tolerance);
DensityModelPtr make_image(const ImageView& image);
DensityModelPtr make_nodal(std::span<const double> values);

}  // namespace powercell
