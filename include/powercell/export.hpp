/// \file
/// Symbol visibility: everything is hidden except what carries POWERCELL_API. And a plain word to older C++.
#pragma once

#if defined(__cplusplus) && __cplusplus < 202002L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#error "powercell needs C++20: compile with -std=c++20, or include powercell.h, which is for older C++ too"
#endif

#include <powercell/c/export.h>
