#include "lib/cl/disk_cache.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "tests/cl/support.hpp"

using namespace powercell;
namespace fs = std::filesystem;

namespace {

cl::CacheKey key_of(std::vector<std::string_view> parts) {
  return cl::CacheKey::of(parts);
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("keys tell apart what differs, also where parts end") {
  const auto key = key_of({"source", "options"});
  CHECK(key == key_of({"source", "options"}));
  CHECK_FALSE(key == key_of({"sourceo", "ptions"}));
  CHECK_FALSE(key == key_of({"source", "options", ""}));
  CHECK_FALSE(key == key_of({"options", "source"}));
  CHECK(key.high != key_of({"source", "option!"}).high);
  CHECK(key.low != key_of({"source", "option!"}).low);
  CHECK(cl::CacheKey{0x0123456789abcdefu, 0xfu}.hex() == "0123456789abcdef000000000000000f");
}

TEST_CASE("an entry comes back as it was written") {
  TemporaryFolder folder;
  const cl::DiskCache cache(folder.path() / "made" / "when needed");
  const auto key = key_of({"a"});
  CHECK_FALSE(cache.read(key));
  for (const std::size_t size : {0u, 1u, 100000u}) {
    cl::Binary binary(size);
    for (std::size_t i = 0; i < size; ++i) binary[i] = static_cast<unsigned char>(i * 7 + 3);
    REQUIRE(cache.write(key, binary));
    const auto back = cache.read(key);
    REQUIRE(back);
    CHECK(*back == binary);
  }
  CHECK(files_in(cache.path(key).parent_path()) == 1);
  CHECK_FALSE(cache.read(key_of({"b"})));
}

TEST_CASE("a damaged entry is deleted, not believed") {
  TemporaryFolder folder;
  const cl::DiskCache cache(folder.path());
  const auto key = key_of({"a"});
  const cl::Binary binary(1000, 42);
  const auto path = cache.path(key);
  auto damaged = [&](auto&& damage) {
    REQUIRE(cache.write(key, binary));
    REQUIRE(cache.read(key));
    damage();
    CHECK_FALSE(cache.read(key));
    CHECK_FALSE(fs::exists(path));
  };
  const auto whole = sizeof(char[40]) + binary.size();
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{7}, std::size_t{39}, std::size_t{40}, whole - 1, whole + 1})
    damaged([&] { fs::resize_file(path, length); });
  for (const int at : {0, 8, 23, 24, 31, 32, 40, 1039})
    damaged([&] {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(at);
      file.put('\x55');
    });
  damaged([&] {  // whole, but of another key
    const auto other = key_of({"b"});
    REQUIRE(cache.write(other, binary));
    fs::rename(cache.path(other), path);
  });
}

TEST_CASE("a folder that cannot be used is a cache without entries") {
  TemporaryFolder folder;
  const auto file = folder.path() / "a file";
  std::ofstream(file) << "not a folder";
  const auto key = key_of({"a"});
  const cl::Binary binary(10, 1);
  for (const fs::path& place : {file, file / "below", fs::path("/proc/nowhere"), fs::path()}) {
    CAPTURE(place.string());
    const cl::DiskCache cache(place);
    CHECK_FALSE(cache.write(key, binary));
    CHECK_FALSE(cache.read(key));
    CHECK_NOTHROW(cache.remove(key));
  }
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("an entry that cannot be put in place leaves nothing behind") {
  TemporaryFolder folder;
  const cl::DiskCache cache(folder.path());
  const auto key = key_of({"a"});
  fs::create_directories(cache.path(key) / "in the way");  // a rename onto a full folder fails
  CHECK_FALSE(cache.write(key, cl::Binary(10, 1)));
  CHECK_FALSE(cache.read(key));
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("where there is no room for an entry, none is left half written") {
  TemporaryFolder folder;
  const cl::DiskCache cache(folder.path());
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const rlimit small{1000, before.rlim_max};  // files end there, as on a full disk
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  const bool written = cache.write(key_of({"a"}), cl::Binary(100000, 1));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK_FALSE(written);
  CHECK(files_in(folder.path()) == 0);
  CHECK(cache.write(key_of({"a"}), cl::Binary(100000, 1)));
}

TEST_CASE("many writers and readers of one entry see it whole") {
  TemporaryFolder folder;
  const auto key = key_of({"a"});
  std::atomic<int> torn{0}, found{0};
  std::vector<std::thread> threads;
  for (unsigned char t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      const cl::DiskCache cache(folder.path());
      for (int i = 0; i < 50; ++i) {
        cache.write(key, cl::Binary(1000 + 500u * t, t));
        const auto binary = cache.read(key);
        if (!binary) continue;
        ++found;
        const unsigned char writer = binary->front();
        torn += *binary != cl::Binary(1000 + 500u * writer, writer);
      }
    });
  for (auto& thread : threads) thread.join();
  CHECK(torn == 0);
  CHECK(found > 0);
  CHECK(files_in(folder.path()) == 1);  // no temporary file stays
}

TEST_CASE("the folder follows the environment") {
  Environment own("POWERCELL_CACHE_DIR", "/own"), xdg("XDG_CACHE_HOME", "/xdg"), home("HOME", "/home/me");
  CHECK(cl::DiskCache::default_folder() == "/own");
  Environment no_own("POWERCELL_CACHE_DIR", "");
  CHECK(cl::DiskCache::default_folder() == "/xdg/powercell");
  Environment no_xdg("XDG_CACHE_HOME", "");
  CHECK(cl::DiskCache::default_folder() == "/home/me/.cache/powercell");
  Environment no_home("HOME", "");
  CHECK(cl::DiskCache::default_folder().empty());
}
