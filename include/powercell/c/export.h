/** \file
 * What the headers for C and for C++ share before all else: legal in C99 and in every C++.
 */
#ifndef POWERCELL_C_EXPORT_H
#define POWERCELL_C_EXPORT_H

#if (defined(__SIZEOF_POINTER__) && __SIZEOF_POINTER__ < 8) || (defined(_WIN32) && !defined(_WIN64))
#error "powercell needs a target of 64 bits, and pointers have fewer here"
#endif

/** Before each name that a shared library exports; everything else is hidden. Programs that link the static
 * libraries define POWERCELL_STATIC; there the archive hides its names in what links it. */
#if defined(POWERCELL_STATIC)
#define POWERCELL_API
#elif defined(_WIN32) || defined(__CYGWIN__)
/* The build of a DLL defines POWERCELL_BUILDING. Those who use it need no dllimport, since there is no data
 * among the exported names; so they need not say whether they link a DLL or a static library. */
#ifdef POWERCELL_BUILDING
#define POWERCELL_API __declspec(dllexport)
#else
#define POWERCELL_API
#endif
#elif defined(__GNUC__)
#define POWERCELL_API __attribute__((visibility("default")))
#else
#define POWERCELL_API
#endif

#endif
