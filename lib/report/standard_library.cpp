#include <powercell/standard_library.hpp>

namespace powercell::built_with {

void POWERCELL_STANDARD_LIBRARY() noexcept {}

}  // namespace powercell::built_with
