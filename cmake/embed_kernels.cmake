# powercell_embed_kernels(target folder): every .cl and .h file below `folder` becomes a string inside
# `target`. Filled in by cmake/embed_kernels_run.cmake at build time, with dependencies on each file.
function(powercell_embed_kernels target folder)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${folder}/*.cl ${folder}/*.h)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_kernels.cpp)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} -DOUTPUT=${output} -P ${PROJECT_SOURCE_DIR}/cmake/embed_kernels_run.cmake
    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/embed_kernels_run.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
