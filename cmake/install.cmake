# Installation of libraries, headers, tool, CMake package and pkg-config files.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS powercell powercell_core powercell_applications EXPORT powercellTargets
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

# Paths in the .pc files are relative to the file, so the installed tree can be moved.
file(RELATIVE_PATH pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix}")

# powercell_pkg_config(NAME DESCRIPTION LIBS REQUIRES STATIC_REQUIRES): writes and installs NAME.pc. A static library
# also requires STATIC_REQUIRES, the packages that a shared one links itself.
function(powercell_pkg_config name description libs requires static_requires)
  set(pc_name ${name})
  set(pc_description "${description}")
  set(pc_libs "${libs}")
  set(pc_cflags "")
  if(NOT BUILD_SHARED_LIBS)
    string(APPEND requires " ${static_requires}")
    set(pc_cflags " -DPOWERCELL_STATIC")
  endif()
  string(STRIP "${requires}" pc_requires)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/powercell.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

set(core_packages "OpenCL geos")
if(POWERCELL_FLANN)
  string(APPEND core_packages " flann")
endif()
set(core_libs "-lpowercell_core")
if(NOT BUILD_SHARED_LIBS)
  string(APPEND core_libs " -lstdc++ -pthread")
endif()
powercell_pkg_config(powercell-core "Power diagrams (weighted Voronoi diagrams) on OpenCL"
  "${core_libs}" "" "${core_packages}")
powercell_pkg_config(powercell "Power diagrams on OpenCL, and applications: transport, sampling, remeshing, treemaps"
  "-lpowercell_applications" "powercell-core" "muparser")

if(TARGET powercell_tool)
  file(RELATIVE_PATH library_from_tool /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(powercell_tool PROPERTIES INSTALL_RPATH "$ORIGIN/${library_from_tool}")
  install(TARGETS powercell_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
