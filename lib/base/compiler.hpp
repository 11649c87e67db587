/// \file
/// What GCC and clang have beyond the C++ standard: here, in vector_copies.hpp and in float_environment.cpp
/// alone, so that a port to another compiler begins and ends there.
#pragma once

#include <cstdint>

#if !defined(__GNUC__)
#error \
    "powercell is compiled by GCC or clang (on Windows MinGW-w64); other compilers need this header's names"
#endif

/// Before a function: a part of loops that are slow with calls.
#define POWERCELL_ALWAYS_INLINE [[gnu::always_inline]] inline

/// `using V POWERCELL_VECTOR(32) = double;`: a vector of so many bytes, with the operators of its elements.
#define POWERCELL_VECTOR(bytes) [[gnu::vector_size(bytes)]]

/// Of a pointer through which alone its array is reached.
#define POWERCELL_RESTRICT __restrict

namespace powercell {

__extension__ using Int128 = __int128;
__extension__ using UnsignedInt128 = unsigned __int128;

/// Loads the cache line at `place` ahead of its use, for accesses at scattered addresses.
inline void prefetch(const void* place) {
  __builtin_prefetch(place);
  asm volatile("");  // or the compiler takes the function for one without effects and drops its calls
}

/// Sets bits of a byte that other threads set bits of too (std::atomic_ref, which libc++ has from 19 on).
inline void add_bits(std::uint8_t& to, std::uint8_t bits) {
  if ((__atomic_load_n(&to, __ATOMIC_RELAXED) & bits) != bits) __atomic_fetch_or(&to, bits, __ATOMIC_RELAXED);
}

}  // namespace powercell
