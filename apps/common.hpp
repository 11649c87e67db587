/// \file
/// What all subcommands of the tool share: options, reporting, the way out on errors.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <powercell/powercell.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace powercell::app {

/// Arguments that cannot be meant: exit code 2, where other errors give 1.
struct WrongUsage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Options that every subcommand which computes accepts.
struct CommonOptions {
  std::string device;
  std::string precision = "auto";
  std::string neighbors = "auto";
  std::string decisions = "exact";
  bool certify = false;
  int threads = 0;
  bool json = false;
  bool quiet = false;
};

/// Adds --json and --quiet.
void add_output_options(CLI::App& command, CommonOptions& options);
/// Adds --neighbors, --decisions, --certify and --threads.
void add_engine_options(CLI::App& command, CommonOptions& options);
/// Adds --device, --precision, --neighbors, --decisions, --threads, --json and --quiet.
void add_common_options(CLI::App& command, CommonOptions& options);

/// Adds --domain, --seeds and --kind.
void add_domain_and_seeds(CLI::App& command, std::string& domain, std::string& kind, std::string& seeds,
                          bool required);
/// What --kind says; nothing when it was not given.
std::optional<DomainKind> domain_kind(const std::string& kind);

/// The library's options for these, with progress and interruption (see interrupt.hpp).
/// \param what  shown beside the progress bar, e.g. "cells"
Options library_options(const CommonOptions& options, std::string_view what);

/// Hands --threads to PoCL, which counts its threads when the first platform is asked for.
void limit_threads(const CommonOptions& options);
/// The device asked for, opened as a computation (see interrupt.hpp), with those threads.
Device open_device(const CommonOptions& options);

const char* precision_name(Precision precision);  ///< "double" or "float"
const char* neighbors_name(Neighbors neighbors);  ///< "tree" or "flann"

/// The registered subcommands. Each returns the function that runs it and gives the exit code.
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

/// "12,345".
std::string with_commas(std::size_t number);

}  // namespace powercell::app
