// The shortest program with a result: measures of a thousand cells in the cube. Timed from outside, it
// includes loading, opening the device with its self-test, and reading kernels from the cache.
#include <cstdint>
#include <cstdio>
#include <powercell/powercell.hpp>
#include <vector>

int main() try {
  constexpr std::size_t n = 1000;
  std::vector<double> positions(3 * n);
  std::uint64_t state = 1;
  for (double& x : positions) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    x = static_cast<double>(state >> 11) * 0x1.0p-53;
  }
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  powercell::Diagram diagram(powercell::Device::choose(), powercell::Domain::box(low, high));
  diagram.set_seeds({3, positions, {}});
  const double error = diagram.measures().relative_error();
  if (error < 1e-4) return 0;
  std::fprintf(stderr, "first_result: the sum of the measures has a relative error of %g\n", error);
  return 1;
} catch (const powercell::Error& error) {
  std::fprintf(stderr, "first_result: %s\n", error.what());
  return 1;
}
