/// \file
/// POWERCELL_VECTOR_COPIES: compiles a function for several widths of vector registers.
#pragma once

// The loader picks the copy for the machine. Contraction is off, so all copies give the same bits. Not under
// sanitizers, which are not initialised yet when the loader runs the resolver.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define POWERCELL_VECTOR_COPIES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define POWERCELL_VECTOR_COPIES
#endif
