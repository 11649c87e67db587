#include <powercell/version.hpp>

namespace powercell {

const char* version() noexcept {
  return POWERCELL_VERSION;
}

}  // namespace powercell
