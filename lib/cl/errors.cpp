#include "lib/cl/errors.hpp"

#include <utility>

namespace powercell::cl {
namespace {

#define POWERCELL_CODE(code) \
  case code:                 \
    return #code

const char* known_name(cl_int status) {
  switch (status) {
    POWERCELL_CODE(CL_SUCCESS);
    POWERCELL_CODE(CL_DEVICE_NOT_FOUND);
    POWERCELL_CODE(CL_DEVICE_NOT_AVAILABLE);
    POWERCELL_CODE(CL_COMPILER_NOT_AVAILABLE);
    POWERCELL_CODE(CL_MEM_OBJECT_ALLOCATION_FAILURE);
    POWERCELL_CODE(CL_OUT_OF_RESOURCES);
    POWERCELL_CODE(CL_OUT_OF_HOST_MEMORY);
    POWERCELL_CODE(CL_PROFILING_INFO_NOT_AVAILABLE);
    POWERCELL_CODE(CL_MEM_COPY_OVERLAP);
    POWERCELL_CODE(CL_IMAGE_FORMAT_MISMATCH);
    POWERCELL_CODE(CL_IMAGE_FORMAT_NOT_SUPPORTED);
    POWERCELL_CODE(CL_BUILD_PROGRAM_FAILURE);
    POWERCELL_CODE(CL_MAP_FAILURE);
    POWERCELL_CODE(CL_MISALIGNED_SUB_BUFFER_OFFSET);
    POWERCELL_CODE(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST);
    POWERCELL_CODE(CL_COMPILE_PROGRAM_FAILURE);
    POWERCELL_CODE(CL_LINKER_NOT_AVAILABLE);
    POWERCELL_CODE(CL_LINK_PROGRAM_FAILURE);
    POWERCELL_CODE(CL_DEVICE_PARTITION_FAILED);
    POWERCELL_CODE(CL_KERNEL_ARG_INFO_NOT_AVAILABLE);
    POWERCELL_CODE(CL_INVALID_VALUE);
    POWERCELL_CODE(CL_INVALID_DEVICE_TYPE);
    POWERCELL_CODE(CL_INVALID_PLATFORM);
    POWERCELL_CODE(CL_INVALID_DEVICE);
    POWERCELL_CODE(CL_INVALID_CONTEXT);
    POWERCELL_CODE(CL_INVALID_QUEUE_PROPERTIES);
    POWERCELL_CODE(CL_INVALID_COMMAND_QUEUE);
    POWERCELL_CODE(CL_INVALID_HOST_PTR);
    POWERCELL_CODE(CL_INVALID_MEM_OBJECT);
    POWERCELL_CODE(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR);
    POWERCELL_CODE(CL_INVALID_IMAGE_SIZE);
    POWERCELL_CODE(CL_INVALID_SAMPLER);
    POWERCELL_CODE(CL_INVALID_BINARY);
    POWERCELL_CODE(CL_INVALID_BUILD_OPTIONS);
    POWERCELL_CODE(CL_INVALID_PROGRAM);
    POWERCELL_CODE(CL_INVALID_PROGRAM_EXECUTABLE);
    POWERCELL_CODE(CL_INVALID_KERNEL_NAME);
    POWERCELL_CODE(CL_INVALID_KERNEL_DEFINITION);
    POWERCELL_CODE(CL_INVALID_KERNEL);
    POWERCELL_CODE(CL_INVALID_ARG_INDEX);
    POWERCELL_CODE(CL_INVALID_ARG_VALUE);
    POWERCELL_CODE(CL_INVALID_ARG_SIZE);
    POWERCELL_CODE(CL_INVALID_KERNEL_ARGS);
    POWERCELL_CODE(CL_INVALID_WORK_DIMENSION);
    POWERCELL_CODE(CL_INVALID_WORK_GROUP_SIZE);
    POWERCELL_CODE(CL_INVALID_WORK_ITEM_SIZE);
    POWERCELL_CODE(CL_INVALID_GLOBAL_OFFSET);
    POWERCELL_CODE(CL_INVALID_EVENT_WAIT_LIST);
    POWERCELL_CODE(CL_INVALID_EVENT);
    POWERCELL_CODE(CL_INVALID_OPERATION);
    POWERCELL_CODE(CL_INVALID_GL_OBJECT);
    POWERCELL_CODE(CL_INVALID_BUFFER_SIZE);
    POWERCELL_CODE(CL_INVALID_MIP_LEVEL);
    POWERCELL_CODE(CL_INVALID_GLOBAL_WORK_SIZE);
    POWERCELL_CODE(CL_INVALID_PROPERTY);
    POWERCELL_CODE(CL_INVALID_IMAGE_DESCRIPTOR);
    POWERCELL_CODE(CL_INVALID_COMPILER_OPTIONS);
    POWERCELL_CODE(CL_INVALID_LINKER_OPTIONS);
    POWERCELL_CODE(CL_INVALID_DEVICE_PARTITION_COUNT);
    case -1001:
      return "CL_PLATFORM_NOT_FOUND_KHR";  // of the ICD loader: cl_ext.h is not needed for it
    default:
      return nullptr;
  }
}

#undef POWERCELL_CODE

[[noreturn]] void fail_forked() {
  throw Error(
      ErrorCode::unsupported,
      "this process was forked from one that had used OpenCL, whose threads it lacks: fork before the first "
      "use of powercell, or start processes anew (posix_spawn, fork with exec; in Python the start methods "
      "'spawn' and 'forkserver')");
}

[[noreturn]] void fail(ErrorCode code, cl_int status, std::string_view what) {
  throw Error(
      code, std::string(what) + ": OpenCL says " + error_name(status) + " (" + std::to_string(status) + ")");
}

}  // namespace

std::string error_name(cl_int status) {
  if (const char* known = known_name(status)) return known;
  return "OpenCL error " + std::to_string(status);
}

void check(cl_int status, std::string_view what) {
  switch (status) {
    case CL_SUCCESS:
      return;
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
    case CL_OUT_OF_HOST_MEMORY:
    case CL_INVALID_BUFFER_SIZE:
      fail(ErrorCode::out_of_device_memory, status, what);
    case status_forked:
      fail_forked();
    case status_not_found:
      throw Error(ErrorCode::unsupported,
                  std::string(what) + ": the OpenCL loader of this machine lacks a function of OpenCL 1.2");
    default:
      fail(ErrorCode::opencl, status, what);
  }
}

void check_query(cl_int status, std::string_view what) {
  if (status == status_forked || status == status_not_found) check(status, what);
  if (status != CL_SUCCESS) fail(ErrorCode::opencl, status, what);
}

bool is_of_device(ErrorCode code) {
  switch (code) {
    case ErrorCode::opencl:
    case ErrorCode::out_of_device_memory:
    case ErrorCode::build_failed:
    case ErrorCode::self_test_failed:
      return true;
    default:
      return false;
  }
}

void require_not_forked() {
  if (is_forked()) fail_forked();
}

void check_allocation(cl_int status, std::string_view what) {
  if (status == CL_OUT_OF_RESOURCES) fail(ErrorCode::out_of_device_memory, status, what);
  check(status, what);
}

}  // namespace powercell::cl
