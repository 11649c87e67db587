/// \file
/// Whether all ranks, or one call and a later one, have the same arguments. Internal.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/base/post.hpp"

namespace powercell {

/// An argument, or what tells it from others.
struct NamedValue {
  std::string name;
  std::uint64_t value;
};

/// \param own  of this rank; on all ranks those of the same names in the same order
/// \throw Error invalid_argument, with what differs
void require_same(const std::vector<NamedValue>& own, Post& post);

}  // namespace powercell
