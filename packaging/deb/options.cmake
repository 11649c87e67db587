# Read by cpack before it packs: who makes the packages, and where they go.
if(NOT CPACK_POWERCELL_PREFIX STREQUAL "/usr")
  message(FATAL_ERROR "the folders of this build are those of ${CPACK_POWERCELL_PREFIX}; Debian packages are made by "
    "packaging/deb/build.sh, which configures one for /usr")
endif()
if("$ENV{DEBFULLNAME}" STREQUAL "" OR "$ENV{DEBEMAIL}" STREQUAL "")
  message(FATAL_ERROR "who makes the packages is written into them: set DEBFULLNAME and DEBEMAIL, as for Debian's own tools")
endif()
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
