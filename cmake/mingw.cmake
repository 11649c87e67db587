# For Windows, by MinGW-w64 of Debian (g++-mingw-w64-x86-64-posix):
#
#   cmake -S . -B build/windows --toolchain cmake/mingw.cmake -DPOWERCELL_APPLICATIONS=OFF -DPOWERCELL_FLANN=OFF \
#     -DPOWERCELL_APPS=OFF -DPOWERCELL_TESTS=OFF
#
# Of Boost and OpenCL headers alone are needed, which are those of this machine: seen through links, since the compiler must
# not see the others beside them. Other libraries are looked for below CMAKE_PREFIX_PATH.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers}/include)
foreach(folder boost CL)
  file(CREATE_LINK /usr/include/${folder} ${headers}/include/${folder} SYMBOLIC)
endforeach()
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32 ${headers} ${CMAKE_PREFIX_PATH})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
list(TRANSFORM CMAKE_FIND_ROOT_PATH APPEND /lib/pkgconfig OUTPUT_VARIABLE folders)
list(JOIN folders ":" folders)
set(ENV{PKG_CONFIG_LIBDIR} "${folders}")
