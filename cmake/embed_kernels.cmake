# powercell_embed_kernels(target folder): embeds every .cl and .h file below `folder` in `target` as a string.
# cmake/embed_kernels_run.cmake writes them again when a file is changed, added or removed.
function(powercell_embed_kernels target folder)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${folder}/*.cl ${folder}/*.h)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_kernels.cpp)
  # The list is a dependency too, or a removed file would stay embedded.
  set(list ${CMAKE_CURRENT_BINARY_DIR}/embedded_kernels.txt)
  file(CONFIGURE OUTPUT ${list} CONTENT "${files}" @ONLY)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} -DOUTPUT=${output} -P ${PROJECT_SOURCE_DIR}/cmake/embed_kernels_run.cmake
    DEPENDS ${files} ${list} ${PROJECT_SOURCE_DIR}/cmake/embed_kernels_run.cmake
    COMMENT "Embedding the kernels"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
