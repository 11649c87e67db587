# powercell_add_test_folders(): makes one doctest executable of each folder of tests/ and tests/applications/ that has
# .cpp files, except support/. Tests include library internals as "lib/..." and shared helpers as "tests/support/...".
# They link the static variant of the libraries and the helpers, or the `library` that a folder.cmake sets: the tool's
# powercell_io links the shared libraries, and a program must not link both.
find_path(DOCTEST_INCLUDE_DIR doctest/doctest.h REQUIRED)
include(${PROJECT_SOURCE_DIR}/tests/support/support.cmake)
# They see the library's Setup besides that of the tests.
set_source_files_properties(diagram/cells_at_boundary.cpp solid/both_ways.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# Without optimisation tests compile in two thirds of the time of -O1. Most of a test's time is in the libraries and
# helpers, which keep theirs.
set(test_options -Wall -Wextra -O0)

# doctest's main function and the headers that most tests begin with, both compiled once for all.
add_library(powercell_test_main OBJECT ${PROJECT_SOURCE_DIR}/tests/support/main.cpp)
target_include_directories(powercell_test_main SYSTEM PRIVATE ${DOCTEST_INCLUDE_DIR})
target_compile_options(powercell_test_main PRIVATE ${test_options} -fPIE)  # as programs: the headers must fit them
target_precompile_headers(powercell_test_main PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional>
  <map> <memory> <random> <span> <string> <vector> <doctest/doctest.h>)

function(powercell_add_test_folders)
  file(GLOB folders CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/* ${CMAKE_CURRENT_SOURCE_DIR}/applications/*)
  foreach(folder IN LISTS folders)
    get_filename_component(name ${folder} NAME)
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    if(IS_DIRECTORY ${folder} AND sources AND NOT name STREQUAL "support")
      add_executable(test_${name} ${sources} $<TARGET_OBJECTS:powercell_test_main>)
      target_include_directories(test_${name} SYSTEM PRIVATE ${DOCTEST_INCLUDE_DIR})
      target_compile_options(test_${name} PRIVATE ${test_options})
      target_precompile_headers(test_${name} REUSE_FROM powercell_test_main)
      set(library powercell_support)
      set(arguments "")
      if(EXISTS ${folder}/folder.cmake)
        include(${folder}/folder.cmake)  # may set these for this folder
      endif()
      target_link_libraries(test_${name} PRIVATE ${library})
      powercell_in_batches(test_${name} 10)
      add_test(NAME ${name} COMMAND test_${name} ${arguments})
    endif()
  endforeach()
endfunction()
