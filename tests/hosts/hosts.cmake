# Programs that link the shared libraries as a host does, on machines that are not as they should be: test_hosts.py runs them.
foreach(host measure forked environment own_queue)
  add_executable(host_${host} ${CMAKE_CURRENT_LIST_DIR}/programs/${host}.cpp)
  target_compile_options(host_${host} PRIVATE -Wall -Wextra)
  target_link_libraries(host_${host} PRIVATE powercell_core)
endforeach()
target_link_libraries(host_own_queue PRIVATE OpenCL::OpenCL)
# Preloaded, it lets devices look like others; named as a driver, it is a platform that fails.
add_library(fake_devices MODULE ${CMAKE_CURRENT_LIST_DIR}/programs/fake_devices.cpp)
target_compile_options(fake_devices PRIVATE -fvisibility=default -Wno-ignored-attributes)
target_link_libraries(fake_devices PRIVATE ${CMAKE_DL_LIBS})
add_library(broken_platform MODULE ${CMAKE_CURRENT_LIST_DIR}/programs/broken_platform.c)
target_compile_options(broken_platform PRIVATE -fvisibility=default)
set_target_properties(fake_devices broken_platform PROPERTIES PREFIX "")
add_test(NAME hosts COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/test_hosts.py
  $<TARGET_FILE_DIR:host_measure> $<TARGET_FILE:powercell_tool>)
set_tests_properties(hosts PROPERTIES PROCESSORS 2)
