# Transport on ranks of MPI, whose linear systems PETSc solves. In the environment of the tests of MPI.
add_executable(test_petsc distributed/petsc/main.cpp distributed/petsc/transport.cpp)
target_include_directories(test_petsc SYSTEM PRIVATE ${DOCTEST_INCLUDE_DIR})
target_compile_options(test_petsc PRIVATE ${test_options})
target_link_libraries(test_petsc PRIVATE powercell_support MPI::MPI_CXX PkgConfig::POWERCELL_PETSC_LIBRARY)
foreach(ranks 1 2 3)
  add_test(NAME petsc_${ranks}
    COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} ${MPIEXEC_PREFLAGS} $<TARGET_FILE:test_petsc> ${MPIEXEC_POSTFLAGS})
  set_tests_properties(petsc_${ranks} PROPERTIES ENVIRONMENT "${mpi_environment}" TIMEOUT 300)
endforeach()
