/// \file
/// The files that a command writes: checked before a long computation, written after it.
#pragma once

#include <functional>
#include <initializer_list>
#include <powercell/diagram.hpp>
#include <string>
#include <vector>

#include "apps/io/maps/frame.hpp"
#include "apps/io/picture/style.hpp"

namespace CLI {
class App;
}

namespace powercell::app {

/// Adds -o, which may be repeated.
/// \param kinds  the known extensions, for the help
/// \param check  throws an Error for an unknown extension, which is reported as wrong usage
void add_output_files(CLI::App& command, std::vector<std::string>& files, const std::string& kinds,
                      std::function<void(const std::string&)> check);

/// Adds --table.
void add_table_file(CLI::App& command, std::string& file);

/// Refuses files that cannot be created, and two names for one file. If one is `-`, reports go to the
/// standard error from here on.
/// \param more  further files; empty names are ignored
/// \param json  whether a report in JSON needs the standard output
/// \throw Error write_failed; WrongUsage
void check_writable(std::vector<std::string> files, std::initializer_list<std::string> more, bool json);

/// What files of a diagram show beside it; see io::DiagramOutput.
struct OutputChoice {
  io::InputView inputs = {};
  bool weights_as_discs = true, whole_cells = false;
  io::PictureStyle style = {};
};

/// Writes the cells to each of the files, by its extension; computes what the diagram has not yet.
void write_diagram(const std::vector<std::string>& files, Diagram& diagram, const SeedsView& seeds,
                   const OutputChoice& choice = {});

}  // namespace powercell::app
