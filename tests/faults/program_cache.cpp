// Every call for the disk cache of compiled programs fails once; programs are then compiled.
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

/// A disk cache for the length of a scope, used even if the driver has its own.
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

/// Opens the device while the nth call of `entry` fails, and checks that nothing leaks.
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

TEST_CASE("a binary that the driver does not return is not cached") {
  const shim::Scope scope;
  const std::string selector = selected();
  for (std::uint64_t nth = 1; nth <= 4; ++nth) {
    CAPTURE(nth);
    const OwnCache cache;
    open_with(selector, Entry::clGetProgramInfo, nth);
    CHECK(cache.entries() == 0);
  }
}

TEST_CASE("a cached binary that the driver refuses is compiled and cached again") {
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
