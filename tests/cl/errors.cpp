#include "lib/cl/errors.hpp"

#include <doctest/doctest.h>

#include <powercell/version.hpp>
#include <set>

#include "tests/cl/support.hpp"

using namespace powercell;

TEST_CASE("every code of OpenCL 1.2 has its own name") {
  std::set<std::string> names;
  int codes = 0;
  auto add = [&](int code) {
    const std::string name = cl::error_name(code);
    CAPTURE(code);
    CHECK(name.starts_with("CL_"));
    names.insert(name);
    ++codes;
  };
  for (int code = 0; code >= -19; --code) add(code);
  for (int code = -30; code >= -68; --code) add(code);
  add(-1001);
  CHECK(names.size() == codes);
  CHECK(cl::error_name(-4) == "CL_MEM_OBJECT_ALLOCATION_FAILURE");
  CHECK(cl::error_name(-1001) == "CL_PLATFORM_NOT_FOUND_KHR");
  CHECK(cl::error_name(-9999) == "OpenCL error -9999");
}

TEST_CASE("codes become errors that say what was being done") {
  CHECK_NOTHROW(cl::check(CL_SUCCESS, "nothing"));
  CHECK_NOTHROW(cl::check_allocation(CL_SUCCESS, "nothing"));
  auto code_of = [](auto function, cl_int status) {
    const auto error = error_of([&] { function(status, "stirring the soup"); });
    REQUIRE(error);
    CHECK(contains(error->what(), "stirring the soup"));
    CHECK(contains(error->what(), cl::error_name(status)));
    return error->code();
  };
  for (const cl_int status :
       {CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_OUT_OF_HOST_MEMORY, CL_INVALID_BUFFER_SIZE}) {
    CHECK(code_of(cl::check, status) == ErrorCode::out_of_device_memory);
    CHECK(code_of(cl::check_allocation, status) == ErrorCode::out_of_device_memory);
  }
  CHECK(code_of(cl::check, CL_OUT_OF_RESOURCES) == ErrorCode::opencl);
  CHECK(code_of(cl::check_allocation, CL_OUT_OF_RESOURCES) == ErrorCode::out_of_device_memory);
  CHECK(code_of(cl::check, CL_INVALID_KERNEL_ARGS) == ErrorCode::opencl);
  CHECK(code_of(cl::check_allocation, CL_INVALID_CONTEXT) == ErrorCode::opencl);
}

TEST_CASE("error codes and the version have names") {
  std::set<std::string> names;
  const int count = static_cast<int>(ErrorCode::internal) + 1;
  for (int code = 0; code < count; ++code) names.insert(name(static_cast<ErrorCode>(code)));
  CHECK(names.size() == count);
  CHECK(names.count("unknown") == 0);
  CHECK(name(ErrorCode::invalid_seed) == std::string("invalid_seed"));
  CHECK(version() == std::string(POWERCELL_VERSION));
}
