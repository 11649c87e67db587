/// \file
/// Telling how far remeshing is, and stopping it.
#pragma once

#include <functional>
#include <powercell/error.hpp>

namespace powercell::remeshing {

/// Calls `progress`, if there is one, with the fraction done. \throw Error interrupted when it returns false
inline void tell(const std::function<bool(double)>& progress, double done) {
  if (progress && !progress(done)) throw Error(ErrorCode::interrupted, "interrupted");
}

}  // namespace powercell::remeshing
