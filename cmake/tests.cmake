# powercell_add_test_folders(): each folder of tests/ that holds .cpp files, except support/, becomes one
# doctest executable. Tests see library internals by "lib/..." and shared helpers by "tests/support/...".
# They link the static twin of the library; a folder.cmake that sets `library` links that instead (the tool's
# powercell_io links the shared library, and one program must not hold both).
find_path(DOCTEST_INCLUDE_DIR doctest/doctest.h REQUIRED)

function(powercell_add_test_folders)
  file(GLOB children RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*)
  foreach(folder IN LISTS children)
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
    if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/${folder} AND sources AND NOT folder STREQUAL "support")
      add_executable(test_${folder} ${sources} ${CMAKE_CURRENT_SOURCE_DIR}/support/main.cpp)
      target_include_directories(test_${folder} SYSTEM PRIVATE ${DOCTEST_INCLUDE_DIR})
      target_compile_options(test_${folder} PRIVATE -Wall -Wextra)
      set(library powercell_test_lib)
      if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/folder.cmake)
        include(${CMAKE_CURRENT_SOURCE_DIR}/${folder}/folder.cmake)  # extra libraries of this folder
      endif()
      target_link_libraries(test_${folder} PRIVATE ${library})
      add_test(NAME ${folder} COMMAND test_${folder})
    endif()
  endforeach()
endfunction()
