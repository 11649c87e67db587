/// \file
/// The inputs of the demo, files of examples/data/, embedded in the tool so that the demo runs anywhere.
#pragma once

#include <span>
#include <string_view>

namespace powercell::app {

struct DemoFile {
  std::string_view name;  ///< of the file to write
  std::string_view text;  ///< its content
};

std::span<const DemoFile> demo_files();

}  // namespace powercell::app
