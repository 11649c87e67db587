/// \file
/// Makes the linker refuse a program whose standard library is another one than that of the library it links,
/// or has containers of other sizes: members of results would be read from wrong places. The undefined name
/// says which.
#pragma once

#include <powercell/export.hpp>
#include <version>

#if defined(_GLIBCXX_DEBUG)
#define POWERCELL_STANDARD_LIBRARY libstdcxx_with_GLIBCXX_DEBUG
#elif defined(_GLIBCXX_USE_CXX11_ABI) && !_GLIBCXX_USE_CXX11_ABI
#define POWERCELL_STANDARD_LIBRARY libstdcxx_with_old_strings
#elif defined(__GLIBCXX__)
#define POWERCELL_STANDARD_LIBRARY libstdcxx
#elif defined(_LIBCPP_VERSION)
#define POWERCELL_STANDARD_LIBRARY libcxx
#else
#define POWERCELL_STANDARD_LIBRARY standard_library
#endif

namespace powercell::built_with {
POWERCELL_API void POWERCELL_STANDARD_LIBRARY() noexcept;
#if defined(__GNUC__)
namespace {
__attribute__((used)) void (*const needed)() noexcept = &POWERCELL_STANDARD_LIBRARY;
}
#endif
}  // namespace powercell::built_with
