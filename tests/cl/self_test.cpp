#include "lib/cl/self_test.hpp"

#include <doctest/doctest.h>

#include "lib/cl/enumerate.hpp"

using namespace powercell;

TEST_CASE("every device of this machine passes the self-test") {
  const auto found = cl::find_devices();
  REQUIRE_FALSE(found.empty());
  for (const auto& entry : found) {
    CAPTURE(entry.info.name);
    CHECK_NOTHROW(cl::self_test(std::make_shared<cl::Context>(entry.platform, entry.device, entry.info)));
  }
}
