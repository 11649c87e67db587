// The C++ side of bench/python_overhead.py: for each line on standard input computes the measures and
// adjacency of the seeds in a file (x, y, z of each, as doubles) in the cube, in a kept diagram, and prints
// one line: seconds, processor seconds, KiB resident before the first diagram and at most, and the sum of the
// measures.
#include <cstdio>
#include <fstream>
#include <iostream>
#include <powercell/diagram.hpp>
#include <powercell/error.hpp>
#include <string>
#include <vector>

#include "bench/clocks.hpp"

namespace {

/// A value of /proc/self/status in KiB.
long memory(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == key + ":") {
      long value = 0;
      status >> value;
      return value;
    }
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fputs("usage: python_overhead SEEDS.bin\n", stderr);
    return 2;
  }
  std::ifstream file(argv[1], std::ios::binary | std::ios::ate);
  std::vector<double> positions(static_cast<std::size_t>(file.tellg()) / sizeof(double));
  file.seekg(0).read(reinterpret_cast<char*>(positions.data()),
                     static_cast<std::streamsize>(positions.size() * sizeof(double)));
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  powercell::Diagram diagram(powercell::Device::choose(), powercell::Domain::box(low, high));
  const long before = memory("VmRSS");
  for (std::string line; std::getline(std::cin, line);) {
    const double wall = powercell::bench::wall_seconds(), processor = powercell::bench::processor_seconds();
    diagram.set_seeds({3, positions, {}});
    diagram.compute(true, false);
    const double took = powercell::bench::wall_seconds() - wall;
    const double used = powercell::bench::processor_seconds() - processor;
    std::printf("%.9f %.9f %ld %ld %.17g\n", took, used, before, memory("VmHWM"), diagram.measures().total());
    std::fflush(stdout);
  }
  return 0;
} catch (const powercell::Error& error) {
  std::fprintf(stderr, "python_overhead: %s\n", error.what());
  return 1;
}
