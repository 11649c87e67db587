// The power cells of three discs in a square: the smallest C++ program that computes a power diagram.
#include <cstdio>
#include <powercell/powercell.hpp>

int main() try {
  const double low[] = {0, 0}, high[] = {1, 1};
  const double positions[] = {0.2, 0.3, 0.7, 0.2, 0.5, 0.8};
  const double radii[] = {0.1, 0.3, 0.2};
  // A weight is a squared length: a disc of radius r has the weight r * r.
  const double weights[] = {radii[0] * radii[0], radii[1] * radii[1], radii[2] * radii[2]};

  powercell::Diagram diagram(powercell::Device::choose(), powercell::Domain::box(low, high));
  diagram.set_seeds({2, positions, weights});
  const powercell::Measures& measures = diagram.measures();
  for (std::size_t i = 0; i < diagram.size(); ++i)
    std::printf("cell %zu: area %.6f, centroid (%.6f, %.6f)\n", i, measures.mass[i], measures.centroid[2 * i],
                measures.centroid[2 * i + 1]);
  std::printf("sum of areas / area of the square = %.15f\n", measures.total() / measures.domain_measure);
  return measures.relative_error() < 1e-12 || diagram.precision() == powercell::Precision::float32 ? 0 : 1;
} catch (const powercell::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
