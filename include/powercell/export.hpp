/// \file
/// Symbol visibility: everything is hidden except what carries POWERCELL_API.
#pragma once

#if defined(POWERCELL_STATIC) || !defined(__GNUC__)
#define POWERCELL_API
#else
#define POWERCELL_API __attribute__((visibility("default")))
#endif
