/// \file
/// Where the domain and the seeds lie on the Earth, and the plane that they are computed in.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/io/maps/frame.hpp"
#include "apps/io/read/polygons.hpp"
#include "apps/io/tables/read_seeds.hpp"

namespace CLI {
class App;
}

namespace powercell::app {

struct MapArguments {
  std::string crs, seeds_crs;
  bool project = false, no_project = false;
};

/// Adds --crs, --seeds-crs, --project and --no-project.
void add_map_options(CLI::App& command, MapArguments& arguments);

struct Georeference {
  io::MapFrame frame;
  std::unique_ptr<io::PointMap> seeds;  ///< from their coordinates to the domain's; null if they are the same
  std::vector<std::string> notes;       ///< for the report
};

/// Decides by the arguments, by what the files say, and by the names of the seeds' columns. Degrees are
/// projected to an equal-area plane; other systems are planes already, unless --project is given. Numbers
/// that only look like degrees stay in their plane, and a note says so.
/// \param file  the argument of --domain
/// \throw Error invalid_argument (unknown systems, options without a map)
Georeference georeference(const MapArguments& arguments, const std::string& file,
                          const io::DomainArrays& domain, const io::SeedColumns& columns);

}  // namespace powercell::app
