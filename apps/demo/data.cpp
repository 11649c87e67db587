// The assembler includes the files as they are, which builds much faster than arrays of numbers in C++.
#include "apps/demo/data.hpp"

#include <array>

#define POWERCELL_EMBED(symbol, file)                                                                    \
  asm(".section .rodata\n"                                                                               \
      ".hidden " #symbol "\n.global " #symbol                                                            \
      "\n"                                                                                               \
      ".hidden " #symbol "_end\n.global " #symbol "_end\n" #symbol ":\n.incbin \"" POWERCELL_DATA_FOLDER \
      "/" file "\"\n" #symbol "_end:\n.byte 0\n.previous\n");                                            \
  extern "C" const char symbol[];                                                                        \
  extern "C" const char symbol##_end[]

POWERCELL_EMBED(powercell_demo_italy, "italy.geojson");
POWERCELL_EMBED(powercell_demo_pretzel, "pretzel.off");
POWERCELL_EMBED(powercell_demo_bracket, "bracket.mesh");
POWERCELL_EMBED(powercell_demo_regions, "italy_regions.csv");
POWERCELL_EMBED(powercell_demo_photo, "photo.png");

namespace powercell::app {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::span<const DemoFile> demo_files() {
  static const std::array<DemoFile, 5> files = {{
      {"italy.geojson", between(powercell_demo_italy, powercell_demo_italy_end)},
      {"pretzel.off", between(powercell_demo_pretzel, powercell_demo_pretzel_end)},
      {"bracket.mesh", between(powercell_demo_bracket, powercell_demo_bracket_end)},
      {"italy_regions.csv", between(powercell_demo_regions, powercell_demo_regions_end)},
      {"photo.png", between(powercell_demo_photo, powercell_demo_photo_end)},
  }};
  return files;
}

}  // namespace powercell::app
