// The assembler includes the files as they are, which builds much faster than arrays of numbers in C++.
#include "apps/demo_data.hpp"

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

namespace powercell::app {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::array<DemoShape, 3> demo_shapes() {
  return {{
      {"italy.geojson", between(powercell_demo_italy, powercell_demo_italy_end),
       "a polygon with a hole and islands"},
      {"pretzel.off", between(powercell_demo_pretzel, powercell_demo_pretzel_end),
       "a closed surface of genus 3"},
      {"bracket.mesh", between(powercell_demo_bracket, powercell_demo_bracket_end),
       "a machine part in tetrahedra"},
  }};
}

}  // namespace powercell::app
