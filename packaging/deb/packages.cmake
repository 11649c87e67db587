# Debian packages by CPack: the two libraries, what builds programs against them, and the tool. packaging/deb/build.sh makes
# them; names follow Debian's rules (a library's from its SONAME).
get_target_property(so_version powercell_core SOVERSION)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME powercell)
set(CPACK_PACKAGE_VENDOR powercell)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL core applications development tool)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/options.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/documents.cmake)
set(CPACK_POST_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/repack.cmake)
set(CPACK_POWERCELL_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_POWERCELL_PREFIX ${CMAKE_INSTALL_PREFIX})

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)  # a library of powercell that another one needs
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

set(CPACK_DEBIAN_CORE_PACKAGE_NAME libpowercell-core${so_version})
set(CPACK_DEBIAN_CORE_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_CORE_PACKAGE_RECOMMENDS "ocl-icd-libopencl1 | libopencl1, pocl-opencl-icd | opencl-icd")
set(CPACK_COMPONENT_CORE_DESCRIPTION "power diagrams on OpenCL: diagrams
Power diagrams (weighted Voronoi diagrams) of polygons, surfaces and volumes,
with exact decisions, on any OpenCL device.
.
This package has the library of diagrams. It needs an OpenCL loader and
driver when it runs, for instance pocl-opencl-icd, which runs on the CPU.")

set(CPACK_DEBIAN_APPLICATIONS_PACKAGE_NAME libpowercell-applications${so_version})
set(CPACK_DEBIAN_APPLICATIONS_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_APPLICATIONS_DEPENDS core)
set(CPACK_COMPONENT_APPLICATIONS_DESCRIPTION "power diagrams on OpenCL: applications
Power diagrams (weighted Voronoi diagrams) of polygons, surfaces and volumes,
with exact decisions, on any OpenCL device.
.
This package has the library of what is built on diagrams: optimal transport,
blue noise sampling, remeshing of surfaces and Voronoi treemaps.")

foreach(library CORE APPLICATIONS)
  set(CPACK_DEBIAN_${library}_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/triggers)
endforeach()

# Static libraries need the development files of what they call, and powercell/opencl.hpp those of OpenCL.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpowercell-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS core applications)
set(static_needs "libmuparser-dev")
if(POWERCELL_FLANN)
  string(APPEND static_needs ", liblz4-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "ocl-icd-opencl-dev | opencl-dev, opencl-c-headers | opencl-headers, ${static_needs}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "power diagrams on OpenCL: development files
Power diagrams (weighted Voronoi diagrams) of polygons, surfaces and volumes,
with exact decisions, on any OpenCL device.
.
This package has the headers for C++ and C, the static libraries, the CMake
package and the files of pkg-config.")

set(CPACK_DEBIAN_TOOL_PACKAGE_NAME powercell)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOL_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")
set(CPACK_COMPONENT_TOOL_DEPENDS core applications)
set(CPACK_COMPONENT_TOOL_DESCRIPTION "power diagrams on OpenCL: command line tool
Power diagrams (weighted Voronoi diagrams) of polygons, surfaces and volumes,
with exact decisions, on any OpenCL device.
.
This package has the tool powercell. It reads maps and meshes and writes
pictures, meshes and tables of cells; it makes optimal transport, blue noise,
new meshes of surfaces and treemaps, and verifies and measures devices.")

include(CPack)
