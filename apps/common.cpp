#include "apps/common.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <map>
#include <memory>

#include "apps/interrupt.hpp"
#include "apps/option_words.hpp"
#include "apps/progress.hpp"

namespace powercell::app {
namespace {

const std::map<std::string, Precision> precisions = {
    {"auto", Precision::automatic}, {"double", Precision::float64}, {"float", Precision::float32}};
const std::map<std::string, Neighbors> providers = {
    {"auto", Neighbors::automatic}, {"tree", Neighbors::tree}, {"flann", Neighbors::flann}};

}  // namespace

void add_device_option(CLI::App& command, CommonOptions& options, const std::string& preface) {
  command
      .add_option("--device", options.device,
                  (preface.empty() ? "Part" : preface + "part") +
                      " of a device's name, its number P:D, cpu or gpu (see 'powercell devices'); several "
                      "with commas between, or all, share the work")
      ->type_name("DEVICE")
      ->check(known_words({"cpu", "gpu", "all"}))
      ->default_str("POWERCELL_DEVICE, else the best GPU, else the CPU");
}

void add_threads_option(CLI::App& command, CommonOptions& options, const std::string& preface) {
  command
      .add_option("--threads", options.threads,
                  (preface.empty() ? "Threads" : preface + "threads") + " on the host and in PoCL; 0 for all")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
}

void add_output_options(CLI::App& command, CommonOptions& options) {
  command.add_flag("--json", options.json, "One JSON object on stdout and nothing else there");
  command.add_flag("--quiet", options.quiet, "No report and no progress bar; errors are still reported");
}

void add_engine_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--neighbors", options.neighbors, "How candidate neighbours are found")
      ->check(one_of({"auto", "tree", "flann"}))
      ->capture_default_str();
  command
      .add_option("--decisions", options.decisions,
                  "exact, or fast: cells whose shape rounding may have decided are counted but not corrected")
      ->check(one_of({"exact", "fast"}))
      ->capture_default_str();
  command.add_flag("--certify", options.certify, "Check each result against laws that need no reference");
  add_threads_option(command, options);
}

void add_common_options(CLI::App& command, CommonOptions& options) {
  add_device_option(command, options);
  command
      .add_option("--precision", options.precision,
                  "Of the computation on the device; auto: double where the device has it, else float")
      ->check(one_of({"auto", "double", "float"}))
      ->capture_default_str();
  add_engine_options(command, options);
  add_output_options(command, options);
}

Options library_options(const CommonOptions& options) {
  Options result;
  result.precision = precisions.at(options.precision);
  result.neighbors = providers.at(options.neighbors);
  result.decisions = options.decisions == "fast" ? Decisions::fast : Decisions::exact;
  result.certify = options.certify;
  result.threads = options.threads;
  result.progress = [](double) { return !interrupted(); };
  return result;
}

Options library_options(const CommonOptions& options, Progress& progress) {
  Options result = library_options(options);
  result.progress = progress.callback();
  return result;
}

void limit_threads(const CommonOptions& options) {
  if (options.threads <= 0) return;
  // PoCL reads these once, when the first platform is queried; values set by the user win.
  const std::string count = std::to_string(options.threads);
  setenv("POCL_MAX_PTHREAD_COUNT", count.c_str(), 0);
  setenv("POCL_CPU_MAX_CU_COUNT", count.c_str(), 0);
}

Device open_device(const CommonOptions& options) {
  limit_threads(options);
  std::optional<Device> device;
  compute([&] { device = Device::choose(options.device); });
  return *device;
}

Device open_single_device(const CommonOptions& options) {
  Device device = open_device(options);
  if (const std::size_t count = device.members().size(); count > 1)
    throw Error(
        ErrorCode::unsupported,
        fmt::format("this command is for one device, and --device or POWERCELL_DEVICE names {}", count));
  return device;
}

std::string device_name(const Device& device) {
  std::vector<std::string> names;
  for (const Device& member : device.members()) names.push_back(member.info().name);
  return fmt::format("{}", fmt::join(names, " + "));
}

const char* precision_name(Precision precision) {
  return precision == Precision::float32 ? "float" : "double";
}

const char* neighbors_name(Neighbors neighbors) {
  return neighbors == Neighbors::flann ? "flann" : "tree";
}

}  // namespace powercell::app
