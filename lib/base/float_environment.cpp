#include "lib/base/float_environment.hpp"

#if defined(__x86_64__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace powercell {

bool FloatEnvironment::is_default() {
#if defined(__x86_64__) && defined(__GNUC__)
  constexpr unsigned settings = 0xffc0, standard = 0x1f80;  // of MXCSR; the low bits are flags
  unsigned short x87 = 0;
  __asm__ volatile("fnstcw %0" : "=m"(x87));
  return (_mm_getcsr() & settings) == standard && (x87 & 0x0f3f) == 0x033f;
#elif defined(_M_X64)
  return (_mm_getcsr() & 0xffc0) == 0x1f80;
#else
  return false;
#endif
}

}  // namespace powercell
