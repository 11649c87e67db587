// Loads the plug-in named by its argument with all names shared, beside the shared library that it uses
// itself.
#include <dlfcn.h>

#include <cstdio>
#include <powercell/powercell.hpp>

int main(int, char** argv) {
  const double low[] = {0, 0}, high[] = {1, 1}, positions[] = {.2, .3, .7, .2};
  powercell::Diagram diagram(powercell::Device::choose(), powercell::Domain::box(low, high));
  diagram.set_seeds({2, positions, {}});
  void* const plugin = dlopen(argv[1], RTLD_NOW | RTLD_GLOBAL);
  if (!plugin) {
    std::puts(dlerror());
    return 1;
  }
  const auto cells = reinterpret_cast<int (*)(const void**)>(dlsym(plugin, "plugin_cells"));
  const void* version = nullptr;
  const bool right = cells(&version) == 3 && diagram.measures().mass.size() == 2;
  std::printf("the plug-in has a copy %s\n",
              version != powercell::version() ? "of its own" : "that it shares");
  return right && version != powercell::version() ? 0 : 1;
}
