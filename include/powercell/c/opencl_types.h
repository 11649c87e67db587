/** \file
 * The types of OpenCL. Its version is the program's choice, before this header or after it: the latest one
 * declares all that others do.
 */
#ifndef POWERCELL_C_OPENCL_TYPES_H
#define POWERCELL_C_OPENCL_TYPES_H

#ifdef CL_TARGET_OPENCL_VERSION
#include <CL/cl.h>
#else
#define CL_TARGET_OPENCL_VERSION 300
#include <CL/cl.h>
#undef CL_TARGET_OPENCL_VERSION
#endif

#endif
