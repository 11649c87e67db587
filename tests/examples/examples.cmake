# The C programs of examples/, built by a C compiler as C99 against the libraries of the build, and what they must print.
# c_program(NAME LIBRARIES): the target example_NAME.
function(c_program name libraries)
  set(target example_${name})
  add_executable(${target} ${PROJECT_SOURCE_DIR}/examples/${name}.c)
  target_compile_options(${target} PRIVATE -Wall -Wextra -pedantic -Werror)
  target_link_libraries(${target} PRIVATE ${libraries} m)
  set_target_properties(${target} PROPERTIES C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF LINKER_LANGUAGE C)
  if(NOT BUILD_SHARED_LIBS)  # the libraries are C++
    set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  endif()
endfunction()
# c_example(NAME LIBRARIES PATTERN...): PATTERNs are Python's regular expressions.
function(c_example name libraries)
  c_program(${name} "${libraries}")
  add_test(NAME example_${name}
    COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/examples/run.py $<TARGET_FILE:example_${name}> ${ARGN})
endfunction()

find_package(OpenCL REQUIRED)  # c_own_queue has a context of its own

c_example(host_c powercell_core "cell 4: volume 0\\.\\d+, walls" "sum of volumes (1\\.0|0\\.99999)")
c_example(c_cells powercell_core
  "cell 0: area \\d\\.\\d+, 1 rings" "cell 2: area \\d" "total 12\\.0000" "border 24\\.000")
c_example(c_out_of_core powercell_core "\\d+ cells in [3-9] pieces, 20000 volumes" "sum of volumes (1\\.0|0\\.99999)")
c_example(c_periodic powercell_core "area 0\\.86602" "(wall 0\\.5773\\d+ with seed 0 .*\\n){6}" "6 walls, 3\\.464")
c_example(c_own_queue "powercell_core;OpenCL::OpenCL" "1000 cells on .* volume (1\\.0000|0\\.9999)")
c_example(c_transport powercell "step 0, start" "cell 0: weight [-+]0\\.\\d+, mass 0\\.3333" "mass 0\\.6666" "mass 1\\.0000"
  "converged, total mass 2\\.0000")
c_example(c_sampling powercell "400 points after \\d+ iterations, 2[45]\\d in the right half" "0\\.001 %: yes"
  "mean spacing 0\\.[789]\\d, of random points 0\\.[456]")
c_example(c_remeshing powercell "repair: nothing to do" "before: 640 vertices" "after: 300 vertices.*characteristic 0"
  "less than 0\\.1: yes")
c_example(c_treemap powercell "energy: 100\\.0000 %" "  sun: 50\\.0000 %" "    roofs: 30\\.0000 %"
  "    fields: 20\\.0000 %" "4 leaves, all within 1e-06: yes")
