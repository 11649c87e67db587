/// \file
/// Names of the library's enumerations in files and options.
#pragma once

#include <optional>
#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <string_view>

namespace powercell::io {

const char* name(DomainKind kind);    ///< "polygon", "surface" or "volume"
const char* name(SeedStatus status);  ///< "ok", "hidden" or "duplicate"

std::optional<DomainKind> domain_kind(std::string_view name);
std::optional<SeedStatus> seed_status(std::string_view name);

}  // namespace powercell::io
