# powercell_add_test_folders(): makes one doctest executable of each folder of tests/ and tests/applications/ that has
# .cpp files, except support/. Tests include library internals as "lib/..." and shared helpers as "tests/support/...".
# They link the static variant of the libraries and the helpers, or the `library` that a folder.cmake sets: the tool's
# powercell_io links the shared libraries, and a program must not link both.
find_path(DOCTEST_INCLUDE_DIR doctest/doctest.h REQUIRED)
include(${PROJECT_SOURCE_DIR}/tests/support/support.cmake)

function(powercell_add_test_folders)
  file(GLOB folders CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/* ${CMAKE_CURRENT_SOURCE_DIR}/applications/*)
  foreach(folder IN LISTS folders)
    get_filename_component(name ${folder} NAME)
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    if(IS_DIRECTORY ${folder} AND sources AND NOT name STREQUAL "support")
      add_executable(test_${name} ${sources} ${CMAKE_CURRENT_SOURCE_DIR}/support/main.cpp)
      target_include_directories(test_${name} SYSTEM PRIVATE ${DOCTEST_INCLUDE_DIR})
      # -O3 compiles these files half as long again as -O1, and most of a test's time is in the libraries and helpers, which
      # keep theirs.
      target_compile_options(test_${name} PRIVATE -Wall -Wextra $<$<CONFIG:Release>:-O1>)
      set(library powercell_support)
      if(EXISTS ${folder}/folder.cmake)
        include(${folder}/folder.cmake)  # sets `library` for this folder
      endif()
      target_link_libraries(test_${name} PRIVATE ${library})
      add_test(NAME ${name} COMMAND test_${name})
    endif()
  endforeach()
endfunction()
