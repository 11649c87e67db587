/// \file
/// The domain and the seeds that a command computes with.
#pragma once

#include <string>
#include <vector>

#include "apps/io/read_domain.hpp"
#include "apps/io/read_seeds.hpp"

namespace CLI {
class App;
}

namespace powercell::app {

struct InputArguments {
  std::string domain, kind, seeds;
  io::ColumnChoice columns;
  bool allow_outside = false;
};

/// Adds --domain, --kind, --seeds and the options on their columns.
void add_inputs(CLI::App& command, InputArguments& arguments, bool required);

struct Inputs {
  io::LoadedDomain domain;
  io::SeedTable seeds;
  std::size_t outside = 0;         ///< seeds outside the domain's box
  std::vector<std::string> notes;  ///< for the report: how the files were read
};

/// \throw Error of the readers; invalid_seed if the seeds miss the domain
Inputs read_inputs(const InputArguments& arguments);

}  // namespace powercell::app
