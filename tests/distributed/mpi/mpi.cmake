# Ranks that are processes of MPI. The libraries are the static ones of the other tests, not those of powercell::mpi.
add_executable(test_mpi distributed/mpi/main.cpp distributed/mpi/ranks.cpp distributed/mpi/c_ranks.cpp)
target_include_directories(test_mpi SYSTEM PRIVATE ${DOCTEST_INCLUDE_DIR})
target_compile_options(test_mpi PRIVATE ${test_options})
target_link_libraries(test_mpi PRIVATE powercell_support MPI::MPI_CXX)

# Containers run as root, with fewer cores than ranks. Each rank has threads, which must not all be on one core.
set(mpi_environment OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
  PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none)
foreach(ranks 1 2 3 5)
  add_test(NAME mpi_${ranks}
    COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} ${MPIEXEC_PREFLAGS} $<TARGET_FILE:test_mpi> ${MPIEXEC_POSTFLAGS})
  list(APPEND mpi_tests mpi_${ranks})
endforeach()
add_test(NAME mpi_killed
  COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/distributed/mpi/killed.py
    ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} 3 ${MPIEXEC_PREFLAGS} $<TARGET_FILE:test_mpi> ${MPIEXEC_POSTFLAGS})

# The examples, against the shared libraries as programs of users.
add_executable(example_particles_mpi ${PROJECT_SOURCE_DIR}/examples/particles_mpi.cpp)
target_compile_options(example_particles_mpi PRIVATE -Wall -Wextra -Werror)
target_link_libraries(example_particles_mpi PRIVATE powercell::mpi)
foreach(ranks 1 3)
  add_test(NAME example_particles_mpi_${ranks}
    COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/examples/run.py --command ${MPIEXEC_EXECUTABLE}
      ${MPIEXEC_NUMPROC_FLAG} ${ranks} ${MPIEXEC_PREFLAGS} $<TARGET_FILE:example_particles_mpi> ${MPIEXEC_POSTFLAGS} 500 4 --
      "step 0: 500 particles, volume (1\\.0000000|0\\.9999999)\\d+, energy 0\\.00" "step 3: 500 particles")
  list(APPEND mpi_tests example_particles_mpi_${ranks})
endforeach()

c_program(c_particles_mpi powercell::mpi)
foreach(ranks 1 2 3 5)
  add_test(NAME example_c_particles_mpi_${ranks}
    COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/examples/run.py --command ${MPIEXEC_EXECUTABLE}
      ${MPIEXEC_NUMPROC_FLAG} ${ranks} ${MPIEXEC_PREFLAGS} $<TARGET_FILE:example_c_particles_mpi> ${MPIEXEC_POSTFLAGS} 400 3 --
      "step 0: 400 particles, volume (1\\.0000000|0\\.9999999)\\d+, energy 0\\.00" "step 2: 400 particles")
  list(APPEND mpi_tests example_c_particles_mpi_${ranks})
endforeach()

# The tool on ranks.
if(TARGET powercell_mpi_tool)
  add_test(NAME cli_ranks COMMAND ${POWERCELL_SYSTEM_PYTHON} ${PROJECT_SOURCE_DIR}/tests/cli/test_ranks.py
    $<TARGET_FILE:powercell_tool> $<TARGET_FILE:powercell_mpi_tool> ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG})
  list(APPEND mpi_tests cli_ranks)
endif()

# A rank that fails a test leaves others waiting, until the time is up.
set_tests_properties(${mpi_tests} mpi_killed PROPERTIES ENVIRONMENT "${mpi_environment}" TIMEOUT 300)
