/// \file
/// Whether all ranks were called with the same domain and options. Internal.
#pragma once

#include <powercell/distributed.hpp>

#include "lib/base/post.hpp"

namespace powercell::exchange {

/// \throw Error invalid_argument, with what differs
void require_same_call(const Domain& domain, const DistributedOptions& options, Post& post);

}  // namespace powercell::exchange
