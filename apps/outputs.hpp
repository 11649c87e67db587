/// \file
/// The files that a command is to write, before it computes what takes long.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace powercell::app {

/// Adds -o: files to write, as often as wanted. \param kinds  which endings there are, for the help
/// \param check  throws an Error for a name that says no format: wrong usage
void add_output_files(CLI::App& command, std::vector<std::string>& files, const std::string& kinds,
                      std::function<void(const std::string&)> check);

/// Refuses files that cannot be created, and two names of one file. \param more  others; empty names are none
/// \throw Error write_failed; WrongUsage
void check_writable(std::vector<std::string> files, std::initializer_list<std::string> more = {});

}  // namespace powercell::app
