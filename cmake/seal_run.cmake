# Joins OBJECTS into the object OUTPUT, of whose symbols those that match NAMES stay global, with hidden visibility.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed)
    file(REMOVE ${OUTPUT})
    message(FATAL_ERROR "${ARGN}\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

# Groups would be dropped in favour of a host's of the same name, but their symbols are about to be local.
run(${LINKER} -r --force-group-allocation -o ${OUTPUT} ${OBJECTS})
run(${OBJCOPY} --localize-hidden ${OUTPUT})
list(TRANSFORM NAMES PREPEND --keep-global-symbol= OUTPUT_VARIABLE kept)
run(${OBJCOPY} --wildcard ${kept} ${OUTPUT})

# Of several visibilities of a symbol the linker takes the narrowest, also that of an object that only mentions it.
run(${NM} --extern-only --defined-only --format=posix ${OUTPUT})
string(REGEX REPLACE "([^ \n]+)[^\n]*\n" ".hidden \\1\n" directives "${said}")
file(WRITE ${OUTPUT}.s "${directives}.section .note.GNU-stack,\"\",%progbits\n")
run(${COMPILER} -c ${OUTPUT}.s -o ${OUTPUT}.hidden)
file(RENAME ${OUTPUT} ${OUTPUT}.joined)
run(${LINKER} -r -o ${OUTPUT} ${OUTPUT}.joined ${OUTPUT}.hidden)
file(REMOVE ${OUTPUT}.joined ${OUTPUT}.hidden ${OUTPUT}.s)
