# powercell_strict: what keeps the exactness of the library whatever flags a parent project or the environment sets. Options
# come after those of CMAKE_CXX_FLAGS and of the folder, and of two that contradict each other the last one holds. Each is
# named, since -fno-fast-math leaves what was asked for by another name. lib/base/strict.hpp, which every source includes
# first, refuses what is left.
include(CheckCXXCompilerFlag)
add_library(powercell_strict INTERFACE)
set(strict_options -ffp-contract=off)  # no fused a * b + c: results are the same bits on every machine
foreach(option
    -fno-fast-math -fno-unsafe-math-optimizations -fno-associative-math -fno-reciprocal-math -fno-finite-math-only
    -fsigned-zeros -ftrapping-math -fno-single-precision-constant -fno-cx-limited-range -fno-rounding-math
    -mno-recip
    -fno-gnu-unique  # such symbols are one in a process whatever their visibility, and keep a library from being unloaded
    -fno-lto  # the archives are made of machine code (cmake/libraries.cmake), and no host's flags reach code by inlining
    -fexceptions -frtti -fno-short-enums -fsigned-char -fvisibility=hidden -fvisibility-inlines-hidden)
  string(MAKE_C_IDENTIFIER "POWERCELL_HAS${option}" has)
  check_cxx_compiler_flag(${option} ${has})
  if(${has})
    list(APPEND strict_options ${option})
  endif()
endforeach()
if(MSVC)
  set(strict_options /fp:precise /EHsc /GR /FI${PROJECT_SOURCE_DIR}/lib/base/strict.hpp)
else()
  list(APPEND strict_options -include ${PROJECT_SOURCE_DIR}/lib/base/strict.hpp)
endif()
target_compile_options(powercell_strict INTERFACE ${strict_options})
