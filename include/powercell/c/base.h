/** \file
 * What all of the C interface shares: statuses, messages, progress, the log and the version.
 */
#ifndef POWERCELL_C_BASE_H
#define POWERCELL_C_BASE_H

#include <powercell/c/export.h> /* first: where it refuses the target, other errors follow */
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Kinds of failures, in the order of powercell::ErrorCode. */
typedef enum pc_status {
  PC_OK = 0,
  PC_INVALID_ARGUMENT,     /**< sizes that do not match, an option out of range, a NULL handle */
  PC_INVALID_SEED,         /**< NaN or infinity in a position or weight */
  PC_INVALID_DOMAIN,       /**< self-intersection, index out of range, empty domain */
  PC_INVALID_FILE,         /**< unreadable or malformed file */
  PC_WRITE_FAILED,         /**< a file could not be written whole */
  PC_DEVICE_NOT_FOUND,     /**< no device matches the selector */
  PC_NO_FP64,              /**< double precision requested on a device without it */
  PC_BUILD_FAILED,         /**< a kernel did not compile */
  PC_SELF_TEST_FAILED,     /**< the device computed a known diagram incorrectly */
  PC_OUT_OF_DEVICE_MEMORY, /**< an allocation failed, even in the smallest chunks */
  PC_OPENCL,               /**< any other OpenCL error */
  PC_UNSUPPORTED,          /**< this build or device does not have the feature */
  PC_INTERRUPTED,          /**< a callback asked to stop */
  PC_NOT_CONVERGED,        /**< an iteration ended above its tolerance */
  PC_INTERNAL,             /**< an invariant of the library does not hold: please report */
  PC_OUT_OF_MEMORY         /**< host memory; std::bad_alloc in C++ */
} pc_status;

/** The library's version, "major.minor.patch"; static storage. */
POWERCELL_API const char* pc_version(void);
/** Stable lower-case name of a status, e.g. "invalid_seed"; static storage. */
POWERCELL_API const char* pc_status_name(pc_status status);
/** The message of the last failure in this thread; "" before the first. Valid until the next failure. */
POWERCELL_API const char* pc_last_error(void);
/** For functions of C on top of the library, as those of powercell_mpi.h: sets what pc_last_error() says in
 * this thread. \param message  is copied; NULL for "" \return status */
POWERCELL_API pc_status pc_fail(pc_status status, const char* message);

/** Receives the fraction done, in [0, 1]; returns 0 to stop the call with PC_INTERRUPTED. A callback of C++
 * that throws stops it too, and its exception is the message. */
typedef int (*pc_progress)(double fraction, void* user);

/** The detail of the log (powercell::LogLevel). */
typedef enum pc_log_level { PC_LOG_INFO = 0, PC_LOG_DETAIL } pc_log_level;

/** Receives a line of the log, ended by a zero byte. It must not call pc_set_log(); what it throws is
 * ignored. */
typedef void (*pc_log_sink)(pc_log_level level, const char* line, void* user);

/** Sends the lines of the log up to level `most` to `sink`, from any thread, one call at a time; NULL removes
 * the sink. Without a sink the environment variable POWERCELL_LOG (info or detail) sends them to standard
 * error. */
POWERCELL_API pc_status pc_set_log(pc_log_sink sink, pc_log_level most, void* user);

#ifdef __cplusplus
}
#endif
#endif
