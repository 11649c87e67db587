// A lattice, whose cells exact decisions alone get right: 6 walls each, and no more.
#include <cstdio>
#include <powercell/powercell.hpp>

int engine_answer();

int main() {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  std::vector<double> positions;
  for (int i = 0; i < 512; ++i)
    for (const int k : {i % 8, i / 8 % 8, i / 64}) positions.push_back((k + 0.5) / 10 + 0.1);
  powercell::Diagram diagram(powercell::Device::choose(), powercell::Domain::box(low, high));
  diagram.set_seeds({3, positions, {}});
  const std::size_t walls = diagram.adjacency().neighbor.size() / 2;
  std::printf("%zu walls, %d\n", walls, engine_answer());
  return walls == 3 * 7 * 64 ? 0 : 1;
}
