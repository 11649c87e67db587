/// \file
/// The command line as a whole: its commands and their options.
#pragma once

#include <CLI/CLI.hpp>
#include <exception>
#include <map>
#include <string>

#include "apps/common.hpp"

namespace powercell::app {

struct CommandLine {
  CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  CLI::App app;
  std::map<std::string, Command> commands;  ///< by name
};

/// The fault of wrong arguments, on one line that proposes the closest option, command or word and points to
/// the help.
/// \param error  of CLI11, or WrongUsage
std::string fault_of_usage(const CLI::App& app, const std::exception& error);

}  // namespace powercell::app
