/// \file
/// Copies of a function for wider vectors. Internal.
#pragma once

// One of the copies is picked by the loader. Contraction is off, so all give the same bits. Sanitizers are
// not yet ready when the loader asks which.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define POWERCELL_VECTOR_COPIES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define POWERCELL_VECTOR_COPIES
#endif
