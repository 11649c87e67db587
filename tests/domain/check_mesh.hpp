/// \file
/// Checks of the contract of RegionMesh, for a domain of any kind, and of refusals.
#pragma once

#include <doctest/doctest.h>

#include <powercell/domain.hpp>
#include <string>

#include "lib/domain/region_mesh.hpp"

namespace powercell::test {

/// Checks offsets, indices, borders from both sides, that each boundary number is used once, the bounding
/// box, that each region is convex or positively oriented, and that the measure is the sum over regions.
void check_mesh(const Domain& domain);

/// The message of the Error invalid_domain that `build` throws; text in parentheses if it does not.
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

/// Checks that the message contains `words`; shows the whole message if it does not.
#define CHECK_CONTAINS(message, words)                  \
  do {                                                  \
    const std::string text = (message);                 \
    CHECK_MESSAGE(text.find(words) != text.npos, text); \
  } while (false)

}  // namespace powercell::test
