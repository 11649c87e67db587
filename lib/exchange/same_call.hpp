/// \file
/// Whether all ranks, or one call and a later one, have the same domain and options. Internal.
#pragma once

#include <cstdint>
#include <powercell/distributed.hpp>
#include <vector>

#include "lib/base/post.hpp"
#include "lib/base/same_values.hpp"

namespace powercell::exchange {

/// The domain and those options that decide what is computed.
std::vector<NamedValue> call_values(const Domain& domain, const Options& options);

/// \throw Error invalid_argument, with what differs
void require_same_call(const Domain& domain, const DistributedOptions& options, Post& post);

}  // namespace powercell::exchange
