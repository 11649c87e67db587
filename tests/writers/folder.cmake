set(library powercell_io)  # the writers, with the shared library
find_package(PkgConfig REQUIRED)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(PUGIXML REQUIRED IMPORTED_TARGET pugixml)
pkg_check_modules(ZLIB REQUIRED IMPORTED_TARGET zlib)
find_package(nlohmann_json REQUIRED)
target_link_libraries(test_writers PRIVATE PkgConfig::CAIRO PkgConfig::PUGIXML PkgConfig::ZLIB nlohmann_json::nlohmann_json)

# Other programs read what was written: VTK, meshio, rsvg-convert. Skipped where Python has no VTK.
add_test(NAME writers_read_back
  COMMAND ${POWERCELL_SYSTEM_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/read_back.py $<TARGET_FILE:test_writers>)
set_tests_properties(writers_read_back PROPERTIES SKIP_RETURN_CODE 77)
