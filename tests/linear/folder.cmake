include(${PROJECT_SOURCE_DIR}/tests/support/support.cmake)
target_link_libraries(test_linear PRIVATE powercell_support)
