include(${PROJECT_SOURCE_DIR}/tests/support/support.cmake)
target_link_libraries(test_device_diagram PRIVATE powercell_support)
