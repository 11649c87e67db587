/// \file
/// Options of callers that were compiled with this or an earlier version of the headers.
#pragma once

#include <powercell/c/options.h>

#include <functional>
#include <powercell/options.hpp>

#include "lib/c_api/calls.hpp"

namespace powercell::c_api {

/// The sizes that a struct of options has had, ascending. A version that adds members, at the end,
/// specialises this with the earlier sizes before the present one.
template <class Struct>
struct KnownSizes {
  static constexpr std::array<std::size_t, 1> values{sizeof(Struct)};
};

template <class Struct>
void check_size(std::size_t size, const char* type) {
  for (const std::size_t known : KnownSizes<Struct>::values)
    if (size == known) return;
  throw Error(ErrorCode::invalid_argument, "a struct_size of " + std::to_string(size) +
                                               " bytes is not one that " + type + " has or had (now " +
                                               std::to_string(sizeof(Struct)) + "): call " + type +
                                               "_init(&options, sizeof options) first, " +
                                               "and do not use a library older than the header");
}

/// Fills the struct of a caller, of which only `size` bytes may be written.
template <class Struct>
pc_status init(Struct* options, std::size_t size, Struct defaults, const char* type) noexcept {
  return guarded([&] {
    checked(options, "options");
    check_size<Struct>(size, type);
    defaults.struct_size = size;
    std::memcpy(static_cast<void*>(options), &defaults, size);
  });
}

/// The options of a caller, with the defaults for members that its version of the struct lacks, or all for
/// NULL.
template <class Struct>
Struct current(const Struct* options, const Struct& defaults, const char* type) {
  Struct all = defaults;
  if (!options) return all;
  check_size<Struct>(options->struct_size, type);
  std::memcpy(static_cast<void*>(&all), options, options->struct_size);
  return all;
}

/// A progress function in C++; empty for NULL.
inline std::function<bool(double)> progress_of(pc_progress call, void* user) {
  if (!call) return {};
  return [call, user](double fraction) {
    return call_back("the progress function", [&] { return call(fraction, user); }) != 0;
  };
}

/// \param options  NULL for the defaults
POWERCELL_API Options options_of(const pc_options* options);

}  // namespace powercell::c_api
