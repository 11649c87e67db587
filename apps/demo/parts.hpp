/// \file
/// The pictures of the demo. Each is what a command of the tool makes from the same files.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <powercell/powercell.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/common.hpp"

namespace powercell::app {

/// A picture and what the page says of it.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a json throws nothing, which its own code does not show
struct DemoPart {
  std::string name;                                          ///< "italy", of the picture italy.png
  std::string title;                                         ///< "A map"
  std::string caption;                                       ///< what is seen, and how to read it
  std::string shown;                                         ///< for those who do not see it
  std::string command;                                       ///< makes the same picture, run in the folder
  std::string topic;                                         ///< command whose help tells more
  std::string document, document_title;                      ///< of this repository, with the section
  std::vector<std::string> files;                            ///< paths, the picture first
  std::vector<std::pair<std::string, std::string>> figures;  ///< what and how much
  std::string line;                                          ///< all that on one line, for the terminal
  nlohmann::json report;                                     ///< for programs
  int width = 0, height = 0;                                 ///< of the picture, pixels
  double seconds = 0;

  std::string picture() const { return name + ".png"; }
};

struct DemoSetting {
  std::filesystem::path folder;
  const CommonOptions& options;
};

using DrawPart = DemoPart (*)(const DemoSetting&, const Device*);

/// \param device  not null
/// \throw Error as the library; internal if a self-check fails
DemoPart draw_map(const DemoSetting& setting, const Device* device);
DemoPart draw_surface(const DemoSetting& setting, const Device* device);
DemoPart draw_volume(const DemoSetting& setting, const Device* device);
DemoPart draw_stipples(const DemoSetting& setting, const Device* device);
/// Without a device.
DemoPart draw_treemap(const DemoSetting& setting, const Device* device);
DemoPart draw_mesh(const DemoSetting& setting, const Device* device);

}  // namespace powercell::app
