/// \file
/// The shapes of examples/data/, carried inside the tool so that the demo runs from anywhere.
#pragma once

#include <array>
#include <string_view>

namespace powercell::app {

struct DemoShape {
  std::string_view file;  ///< name to write it under
  std::string_view text;  ///< the whole file
  std::string_view what;  ///< in words
};

std::array<DemoShape, 3> demo_shapes();

}  // namespace powercell::app
