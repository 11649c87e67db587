# powercell_embed(target folder function header pattern...): embeds every file below `folder` that matches a pattern in
# `target` as a string. `function`, with its namespace, is what `header` declares to return them: pairs of the path below
# the folder and the text, ascending by path. cmake/embed_run.cmake writes them again when a file is changed, added or
# removed.
function(powercell_embed target folder function header)
  list(TRANSFORM ARGN PREPEND ${folder}/ OUTPUT_VARIABLE patterns)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${patterns})
  string(REGEX REPLACE ".*::" "" name ${function})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  # The list is a dependency too, or a removed file would stay embedded.
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${name}.txt)
  file(CONFIGURE OUTPUT ${list} CONTENT "${files}" @ONLY)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} "-DPATTERNS=${patterns}" -DFUNCTION=${function} -DHEADER=${header}
      -DOUTPUT=${output} -P ${PROJECT_SOURCE_DIR}/cmake/embed_run.cmake
    DEPENDS ${files} ${list} ${PROJECT_SOURCE_DIR}/cmake/embed_run.cmake
    COMMENT "Embedding the files of ${folder}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
