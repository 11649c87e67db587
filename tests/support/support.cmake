# Static libraries for tests and benchmarks, each built once:
#   powercell_support   generators, domains, brute force, comparisons
#   powercell_oracles   CGAL and voro++ behind plain headers (CGAL takes long to compile)
# and powercell_opencl_shim, which a test links besides to count OpenCL calls and make them fail.
if(NOT TARGET powercell_support)
  find_package(OpenCL REQUIRED)  # tests have queues and buffers of their own
  set(support ${PROJECT_SOURCE_DIR}/tests/support)
  add_library(powercell_support STATIC EXCLUDE_FROM_ALL
    ${support}/generators.cpp ${support}/meshes.cpp ${support}/domains.cpp ${support}/polytope.cpp
    ${support}/brute_force.cpp ${support}/compare.cpp ${support}/compare_geometry.cpp ${support}/setups.cpp
    ${support}/same_bits.cpp ${support}/permuted.cpp)
  target_compile_options(powercell_support PRIVATE -Wall -Wextra)
  target_link_libraries(powercell_support PUBLIC powercell_static OpenCL::OpenCL)
  target_compile_definitions(powercell_support PUBLIC CL_TARGET_OPENCL_VERSION=120)

  add_library(powercell_opencl_shim OBJECT EXCLUDE_FROM_ALL ${support}/opencl_shim.cpp ${support}/opencl_layer.cpp
    ${support}/opencl_entries.cpp)
  target_compile_options(powercell_opencl_shim PRIVATE -Wall -Wextra)
  target_link_libraries(powercell_opencl_shim PUBLIC powercell_static OpenCL::OpenCL ${CMAKE_DL_LIBS})
  # The library looks its functions up in the process first.
  set_target_properties(powercell_opencl_shim PROPERTIES CXX_VISIBILITY_PRESET default)
  target_link_options(powercell_opencl_shim INTERFACE LINKER:--export-dynamic-symbol=cl*)

  find_package(CGAL REQUIRED)
  find_library(VORO_LIBRARY voro++ REQUIRED)
  add_library(powercell_oracles STATIC EXCLUDE_FROM_ALL ${support}/cgal.cpp ${support}/cgal_periodic.cpp
    ${support}/cgal_solid.cpp ${support}/voro.cpp)
  target_link_libraries(powercell_oracles PUBLIC powercell_support PRIVATE CGAL::CGAL ${VORO_LIBRARY})
  # Two thirds of the time that -O3 takes, which is two minutes for one file of CGAL's.
  target_compile_options(powercell_oracles PRIVATE $<$<CONFIG:Release>:-O1>)
endif()
