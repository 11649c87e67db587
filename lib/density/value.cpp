#include "lib/density/value.hpp"

namespace powercell {

void refuse_density(double value, const std::string& where) {
  throw Error(ErrorCode::invalid_argument, "the density is " + std::to_string(value) + " at " + where +
                                               "; it must be finite and not negative");
}

}  // namespace powercell
