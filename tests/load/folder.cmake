include(${PROJECT_SOURCE_DIR}/tests/support/support.cmake)
target_link_libraries(test_load PRIVATE powercell_support powercell_opencl_shim)
