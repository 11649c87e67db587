// Reads vectors of results in place, as the host's standard library lays them out.
#include <cstdio>
#include <powercell/powercell.hpp>

int main() {
  const double low[] = {0, 0}, high[] = {1, 1}, positions[] = {.2, .3, .7, .2, .5, .8},
               weights[] = {.01, .09, .04};
  powercell::Diagram diagram(powercell::Device::choose(), powercell::Domain::box(low, high));
  diagram.set_seeds({2, positions, weights});
  const powercell::Measures& cells = diagram.measures();
  const powercell::Adjacency& walls = diagram.adjacency();
  std::printf("%zu cells, %zu walls, sum %.12f\n", cells.mass.size(), walls.neighbor.size() / 2,
              cells.total());
  return cells.mass.size() == 3 && cells.centroid.size() == 6 && walls.neighbor.at(0) == 1 ? 0 : 1;
}
