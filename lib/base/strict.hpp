/// \file
/// Refuses compilers and flags under which exact decisions would be wrong. The build includes it first in
/// every source of the libraries (cmake/strict.cmake), whose options undo what a parent project asks for.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||             \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__) || \
    defined(_M_FP_FAST)
#error "powercell decides exactly and cannot be compiled with -ffast-math, -Ofast or a part of them"
#endif

#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "powercell needs arithmetic in the precision of its operands: compile without -mfpmath=387"
#endif
