#include <powercell/log.hpp>
#include <powercell/version.hpp>

#include "lib/c_api/calls.hpp"

namespace powercell::c_api {
namespace {

static_assert(static_cast<int>(ErrorCode::invalid_argument) + 1 == PC_INVALID_ARGUMENT);
static_assert(static_cast<int>(ErrorCode::no_fp64) + 1 == PC_NO_FP64);
static_assert(static_cast<int>(ErrorCode::internal) + 1 == PC_INTERNAL);

thread_local std::string last_error;

}  // namespace

pc_status fail(pc_status status, const char* message) noexcept {
  try {
    last_error = message;
  } catch (...) {
    last_error.clear();
  }
  return status;
}

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

const char* pc_version(void) {
  return version();
}

const char* pc_status_name(pc_status status) {
  const int number = number_in(status);
  if (number == PC_OK) return "ok";
  if (number == PC_OUT_OF_MEMORY) return "out_of_memory";
  if (number < PC_OK || number > PC_OUT_OF_MEMORY) return "unknown";
  return name(static_cast<ErrorCode>(number - 1));
}

const char* pc_last_error(void) {
  return last_error.c_str();
}

pc_status pc_fail(pc_status status, const char* message) {
  return fail(status, message ? message : "");
}

pc_status pc_set_log(pc_log_sink sink, pc_log_level most, void* user) {
  return guarded([&] {
    const auto level = value_of<LogLevel>(most, PC_LOG_DETAIL, "most", "pc_log_level");
    if (!sink) return set_log({});
    set_log(
        [sink, user](LogLevel of, std::string_view line) {
          sink(of == LogLevel::info ? PC_LOG_INFO : PC_LOG_DETAIL, std::string(line).c_str(), user);
        },
        level);
  });
}

}  // extern "C"
