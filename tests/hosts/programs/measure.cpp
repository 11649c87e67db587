// usage: host_measure [SELECTOR]: a diagram on a device. Prints its name; ends with 2 and the reason if it is
// refused.
#include <cmath>
#include <cstdio>
#include <powercell/powercell.hpp>

int main(int argc, char** argv) try {
  powercell::set_log([](powercell::LogLevel, std::string_view line) {
    std::fprintf(stderr, "log: %.*s\n", static_cast<int>(line.size()), line.data());
  });
  for (const powercell::UnusableDevice& unusable : powercell::unusable_devices())
    std::printf("unusable %d:%d %s: %s\n", unusable.platform, unusable.device, unusable.name.c_str(),
                unusable.reason.c_str());
  const double low[] = {0, 0}, high[] = {1, 1};
  powercell::Diagram diagram(powercell::Device::choose(argc > 1 ? argv[1] : ""),
                             powercell::Domain::box(low, high));
  std::vector<double> positions;
  for (int i = 0; i < 400; ++i) positions.push_back(std::fmod((i + 1) * 0.7548776662466927, 1));
  diagram.set_seeds({2, positions, {}});
  const double error = diagram.measures().relative_error();
  for (const powercell::Device& device : diagram.device().members())
    std::printf("used %s\n", device.info().name.c_str());
  return error < 1e-12 ? 0 : 3;
} catch (const powercell::Error& error) {
  std::printf("%s: %s\n", powercell::name(error.code()), error.what());
  return 2;
}
