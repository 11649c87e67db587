#include "apps/driver_probe.hpp"

#include <cstdlib>
#include <filesystem>
#include <powercell/device.hpp>

#if defined(__linux__)
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace powercell::app {

namespace {

constexpr const char* probe = "POWERCELL_DRIVER_PROBE";

#if defined(__linux__)

constexpr const char* vendors = "OCL_ICD_VENDORS";

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

struct Ended {
  bool normally = false;
  std::string last_words;  // the last line on standard error
};

/// Runs this program as a probe.
Ended run_probe() {
  int errors[2];
  if (pipe(errors) != 0) return {true, {}};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, errors[1], STDERR_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclose(&actions, errors[0]);
  char name[] = "powercell", command[] = "devices";
  char* const arguments[] = {name, command, nullptr};
  pid_t child = 0;
  setenv(probe, "1", 1);
  const int failed = posix_spawn(&child, "/proc/self/exe", &actions, nullptr, arguments, environ);
  unsetenv(probe);
  posix_spawn_file_actions_destroy(&actions);
  close(errors[1]);
  Ended ended{failed != 0, {}};
  std::string text;
  char part[4096];
  for (ssize_t read_now = 0; !failed && (read_now = read(errors[0], part, sizeof part)) > 0;)
    text.append(part, static_cast<std::size_t>(read_now));
  close(errors[0]);
  int status = 0;
  if (!failed)
    ended.normally = waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  ended.last_words = text.substr(text.rfind('\n') + 1);
  if (ended.last_words.empty() && WIFSIGNALED(status))
    ended.last_words = "signal " + std::to_string(WTERMSIG(status));
  return ended;
}

/// The files that name drivers to the loader.
std::vector<std::filesystem::path> driver_files() {
  const std::string set = environment(vendors);
  const std::filesystem::path place = set.empty() ? "/etc/OpenCL/vendors" : set;
  std::error_code error;
  if (!std::filesystem::is_directory(place, error)) return {place};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(place, error))
    if (entry.path().extension() == ".icd") files.push_back(entry.path());
  return files;
}

#endif

}  // namespace

#if defined(__linux__)

std::vector<FatalDriver> set_fatal_drivers_aside() {
  if (run_probe().normally) return {};
  const std::string before = environment(vendors);
  std::vector<FatalDriver> fatal;
  std::vector<std::filesystem::path> others;
  for (const std::filesystem::path& file : driver_files()) {
    setenv(vendors, file.c_str(), 1);
    const Ended ended = run_probe();
    if (ended.normally)
      others.push_back(file);
    else
      fatal.push_back({file.string(), ended.last_words});
  }
  std::error_code error;
  char folder[] = "/tmp/powercell-drivers.XXXXXX";
  const bool made = !fatal.empty() && mkdtemp(folder) != nullptr;
  if (made) {
    static const std::filesystem::path kept = folder;
    for (const std::filesystem::path& file : others)
      std::filesystem::copy_file(file, kept / file.filename(), error);
    setenv(vendors, (kept.string() + "/").c_str(), 1);
    std::atexit([] {
      std::error_code ignored;
      std::filesystem::remove_all(kept, ignored);
    });
  } else if (before.empty()) {
    unsetenv(vendors);
  } else {
    setenv(vendors, before.c_str(), 1);
  }
  return fatal;
}

#else

std::vector<FatalDriver> set_fatal_drivers_aside() {
  return {};
}

#endif

bool is_driver_probe() {
  if (!std::getenv(probe)) return false;
  try {
    devices();
  } catch (const Error&) {  // said in the process that asked
  }
  return true;
}

}  // namespace powercell::app
