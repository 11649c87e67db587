/// \file
/// What a folder is for.
#pragma once

#include <vector>

#include "lib/base/mailbox.hpp"
#include "lib/out_of_core/files.hpp"

namespace powercell::out_of_core {

/// Writes down what the call of a new folder has, or compares it with what is written there.
/// \throw Error invalid_argument if they differ, with what does, or if the folder has other files;
/// write_failed
void require_same_call(const LockedFolder& folder, const std::vector<NamedValue>& parts);

}  // namespace powercell::out_of_core
