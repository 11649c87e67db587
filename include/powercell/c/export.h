/** \file
 * What the headers for C and for C++ share before all else: legal in C99 and in every C++.
 */
#ifndef POWERCELL_C_EXPORT_H
#define POWERCELL_C_EXPORT_H

/** Before each name that a shared library exports; everything else is hidden. */
#if defined(POWERCELL_STATIC) || !defined(__GNUC__)
#define POWERCELL_API
#else
#define POWERCELL_API __attribute__((visibility("default")))
#endif

#endif
