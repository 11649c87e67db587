# Run by cpack on the staged files: what Debian wants in each package and other installations do not have. Copyright,
# changelogs, compressed manual pages, lintian's overrides.
find_program(GZIP gzip REQUIRED)
set(date "$ENV{SOURCE_DATE_EPOCH}")
set(command date --utc --rfc-email)
if(NOT date STREQUAL "")
  list(APPEND command --date=@${date})
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C ${command}
  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)

function(compress)
  if(ARGN)
    execute_process(COMMAND ${GZIP} -9nf ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endfunction()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} COMPONENT)
  set(package ${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  if(NOT EXISTS ${root})
    message(FATAL_ERROR "cpack staged nothing in ${root}")
  endif()
  file(REMOVE ${root}/share/doc/powercell/LICENSE ${root}/share/doc/powercell/THIRD_PARTY.md)  # both come below
  file(GLOB rest ${root}/share/doc/powercell/*)
  if(NOT rest)
    file(REMOVE_RECURSE ${root}/share/doc/powercell)
  endif()

  set(documents ${root}/share/doc/${package})
  file(MAKE_DIRECTORY ${documents})
  configure_file(${CPACK_POWERCELL_SOURCE}/packaging/deb/copyright ${documents}/copyright COPYONLY)
  configure_file(${CPACK_POWERCELL_SOURCE}/THIRD_PARTY.md ${documents}/THIRD_PARTY.md COPYONLY)
  configure_file(${CPACK_POWERCELL_SOURCE}/CHANGELOG.md ${documents}/changelog COPYONLY)
  file(WRITE ${documents}/changelog.Debian "powercell (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Packages made from the source of powercell ${CPACK_PACKAGE_VERSION} by its own scripts.

 -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}
")
  compress(${documents}/changelog ${documents}/changelog.Debian)
  file(GLOB manuals ${root}/share/man/man*/*.[0-9])
  compress(${manuals})

  set(overrides ${CPACK_POWERCELL_SOURCE}/packaging/deb/${package}.lintian-overrides)
  if(EXISTS ${overrides})
    configure_file(${overrides} ${root}/share/lintian/overrides/${package} COPYONLY)
  endif()
endforeach()
# The same whatever the umask.
file(GLOB_RECURSE written ${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/*)
file(CHMOD ${written} FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
