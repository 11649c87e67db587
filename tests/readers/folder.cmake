set(library powercell_io)  # the readers and writers of files, with the shared library
# A path of the build, since compilers and their caches may make __FILE__ relative.
target_compile_definitions(test_readers PRIVATE POWERCELL_READERS_DATA="${folder}/data")
