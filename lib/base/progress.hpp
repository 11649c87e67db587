/// \file
/// Reports to a caller's progress callback.
#pragma once

#include <functional>
#include <powercell/error.hpp>

namespace powercell {

/// Calls `progress`, if there is one, with the fraction done. To be called on the caller's thread.
/// \throw Error interrupted if it answers false
inline void report_progress(const std::function<bool(double)>& progress, double done, double total) {
  if (progress && !progress(done / total))
    throw Error(ErrorCode::interrupted, "the computation was stopped by its progress callback");
}

}  // namespace powercell
