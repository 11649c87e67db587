// A plug-in with a static copy of powercell of its own. Its host links the shared library.
#include <powercell.h>

#include <powercell/powercell.hpp>

extern "C" __attribute__((visibility("default"))) int plugin_cells(const void** its_version) {
  const double low[] = {0, 0}, high[] = {1, 1}, positions[] = {.2, .3, .7, .2, .5, .8};
  powercell::Diagram diagram(powercell::Device::choose(), powercell::Domain::box(low, high));
  diagram.set_seeds({2, positions, {}});
  *its_version = powercell::version();
  try {
    powercell::Device::choose("no such device");
  } catch (const powercell::Error& error) {  // its own type
    return error.code() == powercell::ErrorCode::device_not_found
               ? static_cast<int>(diagram.measures().mass.size())
               : -2;
  }
  return -1;
}
