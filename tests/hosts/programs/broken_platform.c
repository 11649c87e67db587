/* An OpenCL driver that answers and cannot list its devices: with the status in BROKEN_STATUS (-6 without
   it), as a vendor's driver does without its kernel module. With BROKEN_NAME set it cannot say its name
   either, and with BROKEN_ENDS set it ends the process, as a driver does whose libraries are missing. */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <CL/cl_icd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct _cl_platform_id {
  cl_icd_dispatch* dispatch;
};
static cl_icd_dispatch table;
static struct _cl_platform_id platform = {&table};

static cl_int broken(void) {
  const char* status = getenv("BROKEN_STATUS");
  return status ? atoi(status) : CL_OUT_OF_HOST_MEMORY;
}

static const char* text_of(cl_platform_info property) {
  switch (property) {
    case CL_PLATFORM_NAME:
      return "Broken Driver";
    case CL_PLATFORM_VENDOR:
      return "Vendor";
    case CL_PLATFORM_VERSION:
      return "OpenCL 1.2 broken";
    case CL_PLATFORM_PROFILE:
      return "FULL_PROFILE";
    case CL_PLATFORM_EXTENSIONS:
      return "cl_khr_icd";
    case CL_PLATFORM_ICD_SUFFIX_KHR:
      return "BRK";
    default:
      return NULL;
  }
}

static CL_API_ENTRY cl_int CL_API_CALL platform_info(cl_platform_id given, cl_platform_info property,
                                                     size_t room, void* value, size_t* size) {
  const char* text = text_of(property);
  (void)given;
  if (property == CL_PLATFORM_NAME && getenv("BROKEN_NAME")) return broken();
  if (!text) return CL_INVALID_VALUE;
  if (size) *size = strlen(text) + 1;
  if (value) {
    if (room < strlen(text) + 1) return CL_INVALID_VALUE;
    strcpy(value, text);
  }
  return CL_SUCCESS;
}

static CL_API_ENTRY cl_int CL_API_CALL device_ids(cl_platform_id given, cl_device_type type, cl_uint room,
                                                  cl_device_id* devices, cl_uint* count) {
  (void)given, (void)type, (void)room, (void)devices, (void)count;
  if (getenv("BROKEN_ENDS")) {
    fputs("error while loading shared libraries: libmissing.so\n", stderr);
    _exit(127);
  }
  return broken();
}

CL_API_ENTRY cl_int CL_API_CALL clIcdGetPlatformIDsKHR(cl_uint room, cl_platform_id* platforms,
                                                       cl_uint* count) {
  table.clGetPlatformInfo = platform_info;
  table.clGetDeviceIDs = device_ids;
  if (count) *count = 1;
  if (room && platforms) platforms[0] = &platform;
  return CL_SUCCESS;
}

CL_API_ENTRY cl_int CL_API_CALL clGetPlatformInfo(cl_platform_id given, cl_platform_info property,
                                                  size_t room, void* value, size_t* size) {
  return platform_info(given, property, room, value, size);
}

CL_API_ENTRY void* CL_API_CALL clGetExtensionFunctionAddress(const char* name) {
  return strcmp(name, "clIcdGetPlatformIDsKHR") ? NULL : (void*)clIcdGetPlatformIDsKHR;
}
