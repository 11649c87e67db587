# What a library shows to the programs that link it: the names of namespace powercell and those that begin with pc_. All others
# (Eigen's, FLANN's, Boost's and the standard library's templates among them) stay its own, so that they are not merged with
# those of a host that was compiled with other flags or versions.
#
#   shared   a version script
#   archive  all objects joined into one, whose other symbols are made local; and names that are shown are hidden in what links
#            the archive, so that a plug-in with a copy of its own does not use that of its host
#
# Where the linker is not one of ELF (Windows, macOS), objects are archived as they are.
set(powercell_seals FALSE)
if(UNIX AND NOT APPLE AND CMAKE_OBJCOPY AND CMAKE_NM AND NOT POWERCELL_SANITIZE AND NOT POWERCELL_FUZZ)
  set(powercell_seals TRUE)
endif()
# Mangled names of functions, members, and of tables and types of classes.
set(powercell_names _ZN9powercell* _ZNK9powercell* _ZT?N9powercell* _ZTTN9powercell* pc_*)

# powercell_seal_shared(target)
function(powercell_seal_shared target)
  if(UNIX AND NOT APPLE)
    list(JOIN powercell_names "; " names)
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/exports.map CONTENT "{ global: ${names}; local: *; };\n" @ONLY)
    target_link_options(${target} PRIVATE LINKER:--version-script=${CMAKE_CURRENT_BINARY_DIR}/exports.map)
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/exports.map)
  endif()
endfunction()

# powercell_sealed_objects(result name objects...): what an archive of the objects is made of.
function(powercell_sealed_objects result name)
  if(NOT powercell_seals)
    set(${result} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${name}.sealed${CMAKE_CXX_OUTPUT_EXTENSION})
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DLINKER=${CMAKE_LINKER} -DOBJCOPY=${CMAKE_OBJCOPY} -DNM=${CMAKE_NM}
      "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DNAMES=${powercell_names}" "-DOBJECTS=${ARGN}" -DOUTPUT=${output}
      -P ${PROJECT_SOURCE_DIR}/cmake/seal_run.cmake
    DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/cmake/seal_run.cmake
    COMMENT "Sealing ${name}" VERBATIM)
  set_source_files_properties(${output} PROPERTIES GENERATED ON EXTERNAL_OBJECT ON)
  # Without a source CMake would not know that programs in C need the C++ runtime.
  set(language ${CMAKE_CURRENT_BINARY_DIR}/${name}.language.cpp)
  file(CONFIGURE OUTPUT ${language} CONTENT "// This archive is of C++.\n" @ONLY)
  set(${result} ${output} ${language} PARENT_SCOPE)
endfunction()
