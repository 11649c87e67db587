#include "lib/applications/density/value.hpp"

#include "lib/base/text.hpp"

namespace powercell {

void refuse_density(double value, const std::string& where) {
  throw Error(ErrorCode::invalid_argument, "the density is " + digits(value) + " at " + where +
                                               "; it must be between 0 and " +
                                               digits(Density::largest_value));
}

}  // namespace powercell
