# The replay of the corpora is an ordinary test; the fuzzers themselves are built by the preset `fuzz` alone.
set(library powercell_io)
find_package(OpenCL REQUIRED)  # device_diagrams.cpp has a context of its own
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
# Readers of the commands' own files, compiled here so that the sanitizers' build is without the commands.
set(command_readers saved bench/saved_record bench/record bench/repeated bench/work)
list(TRANSFORM command_readers REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/apps/\\1.cpp")
target_sources(test_fuzz PRIVATE ${command_readers})
target_link_libraries(test_fuzz PRIVATE fmt::fmt nlohmann_json::nlohmann_json)
target_link_libraries(test_fuzz PRIVATE OpenCL::OpenCL)
target_compile_definitions(test_fuzz PRIVATE POWERCELL_FUZZ_FOLDER="${CMAKE_CURRENT_SOURCE_DIR}/fuzz")
# What tools/keep_reached.sh kept, unpacked beside the tests.
set(reached ${CMAKE_CURRENT_BINARY_DIR}/fuzz_reached)
target_compile_definitions(test_fuzz PRIVATE POWERCELL_FUZZ_REACHED="${reached}")
file(REMOVE_RECURSE ${reached})
file(GLOB archives CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/reached/*.tar.xz)
foreach(archive IN LISTS archives)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${archive})
  get_filename_component(target ${archive} NAME_WE)
  file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${reached}/${target})
endforeach()
# They are a test of their own, since both take minutes under the sanitizers. With the ordinary compiler, where they
# find less, POWERCELL_TEST_ALL=1 asks for them.
set(arguments "-tce=inputs that reach*")
add_test(NAME fuzz_reached COMMAND_EXPAND_LISTS
  COMMAND test_fuzz "-tc=inputs that reach*" $<$<BOOL:${POWERCELL_SANITIZE}>:--no-skip>)
set_tests_properties(fuzz_reached PROPERTIES SKIP_REGULAR_EXPRESSION "test cases: +0 ")
if(POWERCELL_FUZZ)
  file(GLOB fuzz_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/*.cpp)
  list(FILTER fuzz_sources EXCLUDE REGEX "/replay\\.cpp$")
  add_library(powercell_fuzz_support STATIC EXCLUDE_FROM_ALL ${fuzz_sources} ${command_readers})
  target_link_libraries(powercell_fuzz_support PUBLIC powercell_io fmt::fmt nlohmann_json::nlohmann_json OpenCL::OpenCL)
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
