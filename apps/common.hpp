/// \file
/// Options and helpers that the subcommands of the tool share.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <powercell/powercell.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/io/printable.hpp"

namespace CLI {
class App;
}

namespace powercell::app {

/// Invalid command line arguments: exit code 2, where other errors give 1.
struct WrongUsage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Progress;

/// Options of every subcommand that computes.
struct CommonOptions {
  std::string device;
  std::string precision = "auto";
  std::string neighbors = "auto";
  std::string decisions = "exact";
  bool certify = false;
  int threads = 0;
  bool json = false;
  bool quiet = false;

  /// Whether nothing is shown while the command runs.
  bool silent() const { return quiet || json; }
};

/// Adds --device.
/// \param preface  of the help, e.g. "For transport: "
void add_device_option(CLI::App& command, CommonOptions& options, const std::string& preface = {});
/// Adds --threads, likewise.
void add_threads_option(CLI::App& command, CommonOptions& options, const std::string& preface = {});
/// Adds --json and --quiet.
void add_output_options(CLI::App& command, CommonOptions& options);
/// Adds --neighbors, --decisions, --certify and --threads.
void add_engine_options(CLI::App& command, CommonOptions& options);
/// Adds --device, --precision, --neighbors, --decisions, --certify, --threads, --json and --quiet.
void add_common_options(CLI::App& command, CommonOptions& options);

/// The library's options for these, with interruption (see interrupt.hpp).
Options library_options(const CommonOptions& options);
/// The same for a diagram that is the current part of a stage.
Options library_options(const CommonOptions& options, Progress& progress);

/// Passes --threads to PoCL, which reads its number of threads when the first platform is queried.
void limit_threads(const CommonOptions& options);
/// Opens the device of --device with the threads of --threads, interruptibly (see interrupt.hpp).
Device open_device(const CommonOptions& options);
/// \throw Error unsupported if the options name a group
Device open_single_device(const CommonOptions& options);
/// Of a group, all names.
std::string device_name(const Device& device);

const char* precision_name(Precision precision);  ///< "double" or "float"
const char* neighbors_name(Neighbors neighbors);  ///< "tree" or "flann"

/// Register the subcommands. Each returns a function that runs the command and returns the exit code.
using Command = std::function<int()>;
Command add_devices(CLI::App& app);
Command add_diagram(CLI::App& app);
Command add_verify(CLI::App& app);
Command add_demo(CLI::App& app);
Command add_bench(CLI::App& app);
Command add_transport(CLI::App& app);
Command add_treemap(CLI::App& app);
Command add_remesh(CLI::App& app);
Command add_sample(CLI::App& app);
Command add_tune(CLI::App& app);
/// A hidden command of the build: manual pages and completions.
Command add_manuals(CLI::App& app);

using io::with_commas;

}  // namespace powercell::app
