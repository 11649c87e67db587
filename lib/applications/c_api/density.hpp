/// \file
/// The handle of a density.
#pragma once

#include <powercell/c/density.h>

#include <powercell/density.hpp>

#include "lib/c_api/calls.hpp"

struct pc_density {
  explicit pc_density(powercell::Density made) : density(std::move(made)) {}
  powercell::Density density;
};

namespace powercell::c_api {

inline const Density& density_in(const pc_density* handle) {
  return checked(handle, "density").density;
}
/// \param handle  NULL for 1 everywhere
inline Density density_or_one(const pc_density* handle) {
  return handle ? handle->density : Density::constant(1);
}

}  // namespace powercell::c_api
