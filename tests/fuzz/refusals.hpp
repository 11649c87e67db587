/// \file
/// What the library may refuse, and how.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <powercell/error.hpp>
#include <string>

#include "tests/fuzz/input.hpp"

namespace powercell::fuzz {

/// What only the caller did wrong.
inline constexpr std::initializer_list<ErrorCode> kCallersFaults = {
    ErrorCode::invalid_argument, ErrorCode::invalid_seed, ErrorCode::invalid_domain, ErrorCode::unsupported};

/// Runs `body`. A refusal must have one of the codes and a readable message. \return whether all was accepted
template <class Body>
bool accepted(std::initializer_list<ErrorCode> codes, Body body) {
  try {
    body();
    return true;
  } catch (const Error& error) {
    require(std::find(codes.begin(), codes.end(), error.code()) != codes.end(),
            std::string("refused as ") + name(error.code()) + ": " + error.what());
    require_readable(error.what());
    return false;
  }
}

}  // namespace powercell::fuzz
