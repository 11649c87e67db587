// The figures of the paper, those named on the command line: figure3 figure4 figure6 figure8 figure9
// figure10. Writes a CSV file each; see run.sh.
#include <cstdio>
#include <map>

#include "bench/paper/figures.hpp"

using namespace powercell;
using namespace powercell::paper;

int main(int argc, char** argv) {
  try {
    const std::map<std::string, void (*)(const Study&)> figures = {
        {"figure3", lift_figure}, {"figure4", length_figure},  {"figure6", twins_figure},
        {"figure8", sets_figure}, {"figure9", surface_figure}, {"figure10", volume_figure}};
    const Command command = parse_command(argc, argv);
    for (const std::string& word : command.words) {
      const auto figure = figures.find(word);
      if (figure == figures.end()) throw Error(ErrorCode::invalid_argument, "no figure is called " + word);
      std::fprintf(stderr, "%s ...\n", word.c_str());
      figure->second(command.study);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "paper_figures: %s\n", error.what());
    return 1;
  }
  return 0;
}
