/// \file
/// The contract of RegionMesh, checked on a domain of any kind.
#pragma once

#include <doctest/doctest.h>

#include <powercell/domain.hpp>
#include <string>

#include "lib/domain/region_mesh.hpp"

namespace powercell::test {

/// Offsets, indices, borders there and back, boundary numbers used once each, bounding box, convexity
/// or positive orientation of each region, and the measure as the sum over regions.
void check_mesh(const Domain& domain);

/// What `build` says when it refuses with invalid_domain.
template <class Build>
std::string refusal(Build&& build) {
  try {
    build();
  } catch (const Error& error) {
    return error.code() == ErrorCode::invalid_domain ? error.what()
                                                     : "(wrong code) " + std::string(error.what());
  }
  return "(accepted)";
}

/// The message has the words; the whole message is shown when it has not.
#define CHECK_SAYS(message, words)                      \
  do {                                                  \
    const std::string said = (message);                 \
    CHECK_MESSAGE(said.find(words) != said.npos, said); \
  } while (false)

}  // namespace powercell::test
