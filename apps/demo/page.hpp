/// \file
/// The page that shows the pictures of the demo.
#pragma once

#include <span>
#include <string>

#include "apps/demo/parts.hpp"

namespace powercell::app {

/// Seconds from which compiling kernels is worth a word.
inline constexpr double noticeable_build = 0.7;

struct DemoRun {
  std::string device, platform;
  double seconds = 0;  ///< of the run so far
  double build = 0;    ///< of compiling kernels, of all threads together
  /// The way from the page's folder to that of this repository's documents, "../docs/guide.md" without its
  /// last two parts; empty if they are not there.
  std::string repository;
  bool has_documents = false;
};

/// One page of HTML without scripts of others, fonts or anything from the network.
std::string demo_page(std::span<const DemoPart> parts, const DemoRun& run);

}  // namespace powercell::app
