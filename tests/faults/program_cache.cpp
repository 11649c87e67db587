// The cache of compiled programs fails call by call: programs are compiled instead.
#include <doctest/doctest.h>

#include <filesystem>

#include "tests/support/environment.hpp"
#include "tests/support/opencl_shim.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;
using shim::Entry;

namespace {

std::filesystem::path new_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "powercell-cache-XXXXXX").string();
  return mkdtemp(pattern.data());
}

/// A cache of its own, used also where the driver has one, for the length of a scope.
class OwnCache {
 public:
  ~OwnCache() { std::filesystem::remove_all(folder_); }
  std::size_t entries() const {
    using Files = std::filesystem::directory_iterator;
    return static_cast<std::size_t>(std::distance(Files(folder_), Files()));
  }

 private:
  std::filesystem::path folder_ = new_folder();
  Environment place_{"POWERCELL_CACHE_DIR", folder_.string()}, use_{"POWERCELL_CACHE", "always"};
};

std::uint64_t calls(Entry entry) {
  return shim::calls()[static_cast<std::size_t>(entry)];
}

std::string selected() {
  return all_setups().front().device.info().selector();
}

/// Opens the device with the nth call of `entry` failing; nothing may be left of it.
void open_with(const std::string& selector, Entry entry, std::uint64_t nth) {
  const shim::Alive before = shim::alive();
  shim::reset_calls();
  shim::fail(entry, nth, CL_OUT_OF_RESOURCES);
  CHECK_NOTHROW(Device::choose(selector));
  CHECK(shim::fired());
  shim::behave();
  CHECK(shim::alive() == before);
}

}  // namespace

TEST_CASE("a binary that the driver does not hand out is not kept") {
  const shim::Scope scope;
  const std::string selector = selected();
  for (std::uint64_t nth = 1; nth <= 4; ++nth) {
    CAPTURE(nth);
    const OwnCache cache;
    open_with(selector, Entry::clGetProgramInfo, nth);
    CHECK(cache.entries() == 0);
  }
}

TEST_CASE("a binary that the driver does not take is compiled anew, and kept again") {
  const shim::Scope scope;
  const std::string selector = selected();
  for (const Entry entry : {Entry::clCreateProgramWithBinary, Entry::clBuildProgram}) {
    const OwnCache cache;
    Device::choose(selector);
    REQUIRE(cache.entries() == 1);
    open_with(selector, entry, 1);
    CHECK(calls(Entry::clCreateProgramWithSource) == 1);
    CHECK(cache.entries() == 1);
    shim::reset_calls();
    Device::choose(selector);
    CHECK(calls(Entry::clCreateProgramWithSource) == 0);
  }
}
