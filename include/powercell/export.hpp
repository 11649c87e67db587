/// \file
/// Symbol visibility: everything is hidden except what carries POWERCELL_API. And a plain word to older C++.
#pragma once

#if defined(__cplusplus) && __cplusplus < 202002L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#error "powercell needs C++20: compile with -std=c++20"
#endif

#if defined(POWERCELL_STATIC) || !defined(__GNUC__)
#define POWERCELL_API
#else
#define POWERCELL_API __attribute__((visibility("default")))
#endif
