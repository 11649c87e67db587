# Installation: library, headers, tool, CMake package and pkg-config file.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set_target_properties(powercell PROPERTIES EXPORT_NAME powercell)
install(TARGETS powercell EXPORT powercellTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/powercell)
install(EXPORT powercellTargets NAMESPACE powercell:: DESTINATION ${package_folder})
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/powercellConfig.cmake.in ${PROJECT_BINARY_DIR}/powercellConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/powercellConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)  # before 1.0 a minor version may change the interface
install(FILES
  ${PROJECT_BINARY_DIR}/powercellConfig.cmake
  ${PROJECT_BINARY_DIR}/powercellConfigVersion.cmake
  DESTINATION ${package_folder})

# Paths in the .pc file are relative to its own place, so the tree can be moved after installation.
file(RELATIVE_PATH pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix}")
if(BUILD_SHARED_LIBS)
  set(pc_private "Requires.private: OpenCL")
  set(pc_cflags "")
else()
  set(pc_private "Requires: OpenCL geos muparser")
  if(POWERCELL_FLANN)
    string(APPEND pc_private " flann")
  endif()
  string(APPEND pc_private "\nLibs.private: -lstdc++ -pthread")
  set(pc_cflags " -DPOWERCELL_STATIC")
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/powercell.pc.in ${PROJECT_BINARY_DIR}/powercell.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/powercell.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(TARGET powercell_tool)
  file(RELATIVE_PATH library_from_tool /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(powercell_tool PROPERTIES INSTALL_RPATH "$ORIGIN/${library_from_tool}")
  install(TARGETS powercell_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
