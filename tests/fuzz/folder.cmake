# The replay of the corpora is an ordinary test; the fuzzers themselves are built by the preset `fuzz` alone.
set(library powercell_commands)  # files that commands read, and powercell_io
find_package(OpenCL REQUIRED)  # device_diagrams.cpp has a context of its own
target_link_libraries(test_fuzz PRIVATE OpenCL::OpenCL)
target_compile_definitions(test_fuzz PRIVATE POWERCELL_FUZZ_FOLDER="${CMAKE_CURRENT_SOURCE_DIR}/fuzz")
if(POWERCELL_FUZZ)
  file(GLOB fuzz_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/*.cpp)
  list(FILTER fuzz_sources EXCLUDE REGEX "/replay\\.cpp$")
  add_library(powercell_fuzz_support STATIC EXCLUDE_FROM_ALL ${fuzz_sources})
  target_link_libraries(powercell_fuzz_support PUBLIC powercell_commands OpenCL::OpenCL)
  add_custom_target(powercell_fuzz_targets)
  # A target for each folder of inputs, of the function of that name in targets.hpp.
  file(GLOB targets RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus CONFIGURE_DEPENDS
    ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/*)
  foreach(target IN LISTS targets)
    add_executable(fuzz_${target} EXCLUDE_FROM_ALL ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/driver/libfuzzer.cpp)
    target_compile_definitions(fuzz_${target} PRIVATE POWERCELL_FUZZ_TARGET=${target})
    target_link_libraries(fuzz_${target} PRIVATE powercell_fuzz_support -fsanitize=fuzzer)
    add_dependencies(powercell_fuzz_targets fuzz_${target})
  endforeach()
endif()
