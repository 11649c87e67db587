/// \file
/// The shapes of examples/data/, embedded in the tool so that the demo runs anywhere.
#pragma once

#include <array>
#include <string_view>

namespace powercell::app {

struct DemoShape {
  std::string_view file;         ///< name of the file to write
  std::string_view text;         ///< its content
  std::string_view description;  ///< for people
};

std::array<DemoShape, 3> demo_shapes();

}  // namespace powercell::app
