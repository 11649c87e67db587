# Installation of libraries, headers, tool and CMake package. What names no component is a part of the tool's.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME tool)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/powercell)

# powercell_install(KIND SUFFIX): the libraries of a kind (shared or static), whose targets end in SUFFIX, each exported to
# a file of its own.
function(powercell_install kind suffix)
  set(export_core powercell-core-${kind})
  set(export_applications powercell-applications-${kind})
  if(TARGET powercell_applications${suffix})
    install(TARGETS powercell${suffix} EXPORT ${export_applications})
  endif()
  foreach(name core applications)
    if(NOT TARGET powercell_${name}${suffix})
      continue()
    endif()
    install(TARGETS powercell_${name}${suffix} EXPORT ${export_${name}}
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name} NAMELINK_COMPONENT development
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
      RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${name}
      INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    install(EXPORT ${export_${name}} NAMESPACE powercell:: DESTINATION ${package_folder} COMPONENT development)
  endforeach()
endfunction()
if(BUILD_SHARED_LIBS)
  powercell_install(shared "")
  if(TARGET powercell_applications)  # finds the core beside it, also in a moved tree
    set_target_properties(powercell_applications PROPERTIES INSTALL_RPATH "$ORIGIN")
  endif()
else()
  powercell_install(static "")
endif()
if(TARGET powercell_archive)
  powercell_install(static "_archive")
endif()

set(headers_left_out "")
foreach(part mpi petsc)
  string(TOUPPER POWERCELL_${part} option)
  if(NOT ${option})
    list(APPEND headers_left_out PATTERN ${part}.hpp EXCLUDE PATTERN powercell_${part}.h EXCLUDE)
  endif()
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  ${headers_left_out})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD_PARTY.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT core)

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/powercellConfig.cmake.in ${PROJECT_BINARY_DIR}/powercellConfig.cmake
  INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/powercellConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)  # before 1.0 a minor version may change the interface
install(FILES
  ${PROJECT_BINARY_DIR}/powercellConfig.cmake
  ${PROJECT_BINARY_DIR}/powercellConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT development)

if(TARGET powercell_tool)
  file(RELATIVE_PATH library_from_tool /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(powercell_tool PROPERTIES INSTALL_RPATH "$ORIGIN/${library_from_tool}")
  install(TARGETS powercell_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(TARGET powercell_mpi_tool)
    set_target_properties(powercell_mpi_tool PROPERTIES INSTALL_RPATH "$ORIGIN/${library_from_tool}")
    install(TARGETS powercell_mpi_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
  endif()
  if(TARGET powercell_manuals)
    install(DIRECTORY ${PROJECT_BINARY_DIR}/share/man/ DESTINATION ${CMAKE_INSTALL_MANDIR})
    install(DIRECTORY ${PROJECT_BINARY_DIR}/share/bash-completion ${PROJECT_BINARY_DIR}/share/zsh
      ${PROJECT_BINARY_DIR}/share/fish DESTINATION ${CMAKE_INSTALL_DATADIR})
  endif()
endif()
