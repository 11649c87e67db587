# Polygons are checked by GEOS too, which the tool uses.
find_package(PkgConfig REQUIRED)
pkg_check_modules(POWERCELL_TESTED_GEOS REQUIRED IMPORTED_TARGET geos)
target_link_libraries(test_domain PRIVATE PkgConfig::POWERCELL_TESTED_GEOS)
