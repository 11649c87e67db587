#include "apps/bench/host.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <powercell/opencl.hpp>
#include <string_view>
#include <thread>

#include "apps/io/printable.hpp"

namespace powercell::app {
namespace {

/// What follows the first line that begins with `key` and then `separator`, without blanks and quotes around.
std::string value_in_file(const char* path, std::string_view key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    const std::string_view name = std::string_view(line).substr(0, line.find_last_not_of(" \t", at - 1) + 1);
    if (name != key) continue;
    const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
    return begin == std::string::npos ? "" : line.substr(begin, line.find_last_not_of(" \t\"") + 1 - begin);
  }
  return {};
}

std::string cpu_name(const utsname& machine) {
  // Of x86; ARM names an implementer and a part by numbers there, and the board elsewhere.
  if (std::string name = value_in_file("/proc/cpuinfo", "model name", ':'); !name.empty()) return name;
  if (std::string name = value_in_file("/proc/cpuinfo", "cpu", ':'); !name.empty()) return name;  // POWER
  std::ifstream board("/proc/device-tree/model");
  if (std::string name; std::getline(board, name, '\0') && !name.empty()) return name;
  return machine.machine;
}

unsigned usable_processors() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<unsigned>(CPU_COUNT(&set));
  return std::thread::hardware_concurrency();
}

/// A text of the loader itself, which ocl-icd and that of Khronos tell.
std::string loader_text(unsigned which) {
  using Ask = int (*)(unsigned, std::size_t, void*, std::size_t*);
  const auto ask = reinterpret_cast<Ask>(opencl_function("clGetICDLoaderInfoOCLICD"));
  std::array<char, 200> text{};
  if (!ask || ask(which, text.size() - 1, text.data(), nullptr) != 0) return {};
  return text.data();
}

std::string loader_name() {
  constexpr unsigned version = 2, name = 3;  // CL_ICDL_VERSION, CL_ICDL_NAME
  std::string text = loader_text(name);
  if (const std::string number = loader_text(version); !number.empty())
    text += (text.empty() ? "" : " ") + number;
  void* call = opencl_function("clGetPlatformIDs");
  Dl_info place{};
  if (!call || dladdr(call, &place) == 0 || !place.dli_fname) return text;
  std::error_code unknown;
  const auto path = std::filesystem::canonical(place.dli_fname, unknown);
  return text + (text.empty() ? "" : ", ") + (unknown ? place.dli_fname : path.string());
}

/// The first line is "cpu", and the ticks of all processors: user, nice, system, idle, waiting, interrupts
/// (two kinds), stolen, and what is part of the first two.
std::optional<double> busy_seconds(const std::string& path) {
  std::ifstream file(path);
  std::string name;
  std::array<double, 8> ticks{};
  file >> name;
  for (double& count : ticks) file >> count;
  const long ticks_a_second = sysconf(_SC_CLK_TCK);
  if (!file || name != "cpu" || ticks_a_second <= 0) return {};
  constexpr std::size_t idle = 3, waiting = 4;
  ticks[idle] = ticks[waiting] = 0;
  return std::accumulate(ticks.begin(), ticks.end(), 0.0) / static_cast<double>(ticks_a_second);
}

double own_seconds() {
  double sum = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

}  // namespace

HostInfo host_info() {
  HostInfo host;
  utsname machine{};
  uname(&machine);
  host.cpu = cpu_name(machine);
  host.processors = usable_processors();
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0)
    host.memory_bytes = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
  const std::string name = value_in_file("/etc/os-release", "PRETTY_NAME", '=');
  host.system = fmt::format("{}{}{} {}, {}", name, name.empty() ? "" : ", ", machine.sysname, machine.release,
                            machine.machine);
  host.opencl_loader = loader_name();
  for (std::string* text : {&host.cpu, &host.system, &host.opencl_loader}) *text = io::printable(*text);
  return host;
}

HostState host_state(const std::string& root) {
  HostState state;
  state.busy = busy_seconds(root + "/proc/stat");
  state.own = own_seconds();
  state.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  std::ifstream load(root + "/proc/loadavg");
  double average = 0;
  while (state.load.size() < 3 && load >> average) state.load.push_back(average);
  for (unsigned cpu = 0;; ++cpu) {
    std::ifstream clock(fmt::format("{}/sys/devices/system/cpu/cpu{}/cpufreq/scaling_cur_freq", root, cpu));
    double kilohertz = 0;
    if (!(clock >> kilohertz)) break;
    state.clock_mhz.push_back(1e-3 * kilohertz);
  }
  return state;
}

std::optional<double> used_by_others(const HostState& before, const HostState& after) {
  const double seconds = after.seconds - before.seconds;
  if (!before.busy || !after.busy || !(seconds > 0)) return {};
  return std::max(0.0, (*after.busy - *before.busy - (after.own - before.own)) / seconds);
}

}  // namespace powercell::app
