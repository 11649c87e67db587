/// \file
/// The domain and the seeds that a command computes with.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/domain_choice.hpp"
#include "apps/georeference.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "apps/report.hpp"

namespace CLI {
class App;
}

namespace powercell::app {

struct InputArguments : DomainArguments, MapArguments {
  std::string seeds;
  io::ColumnChoice columns;
  std::string scale_weights;  // a number or "auto"
  bool allow_outside = false;
};

/// Adds --domain, --kind, --seeds and the options on their columns and maps.
void add_inputs(CLI::App& command, InputArguments& arguments, bool required);

/// The coordinates of shifts in tables of walls.
inline int shift_axes(const Domain& domain) {
  return domain.is_periodic() ? domain.dimension() : 0;
}

struct Inputs {
  io::LoadedDomain domain;
  io::SeedTable seeds;
  io::MapFrame map;
  std::size_t outside = 0;         ///< seeds outside the domain's box
  std::vector<std::string> notes;  ///< for the report: how the files were read

  io::InputView view() const { return {&seeds, &map}; }
};

/// \throw Error of the readers; invalid_seed if the seeds miss the domain
Inputs read_inputs(const InputArguments& arguments);

/// The domain alone, in the coordinates of its file.
/// \param way  of computing, which needs these coordinates, for the message
/// \param columns  of the seeds, by the dimension
/// \param notes  receives how it was read
/// \throw WrongUsage if seeds or domain would be projected
io::LoadedDomain read_plane_domain(const InputArguments& arguments, const std::string& way,
                                   const std::function<io::SeedColumns(int dimension)>& columns,
                                   std::vector<std::string>& notes);

/// Adds a note where weights that are far too large hide most seeds.
void note_hidden(Inputs& inputs, const RunReport& report);

/// Enters what a report says of them.
void describe_inputs(const Inputs& inputs, RunReport& report);

}  // namespace powercell::app
