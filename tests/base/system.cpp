#include "lib/base/system.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string_view>

using namespace powercell;

namespace {

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("powercell-system-" + system::process_number());
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

}  // namespace

TEST_CASE("a file that was written is mapped as it is") {
  const Folder folder;
  std::error_code error;
  CHECK(system::map_file(folder.path / "none", error).empty());
  CHECK(error == std::errc::no_such_file_or_directory);
  for (const std::string_view text : {"", "a few bytes\r\n\x1a and more"}) {
    const std::filesystem::path path = folder.path / "fil\u00e9";
    std::FILE* const file = system::create_file(path, error);
    REQUIRE(file != nullptr);
    CHECK(std::fwrite(text.data(), 1, text.size(), file) == text.size());
    system::write_to_disk(file, error);
    CHECK(!error);
    std::fclose(file);
    const std::span<const std::byte> bytes = system::map_file(path, error);
    CHECK(!error);
    system::drop(bytes);
    CHECK(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()) == text);
    system::unmap(bytes);
  }
  CHECK(system::create_file(folder.path / "none" / "file", error) == nullptr);
  CHECK(error);
  CHECK(!system::is_full(error));
}

TEST_CASE("one at a time holds a lock") {
  const Folder folder;
  std::error_code error;
  system::FileLock lock;
  CHECK(!lock.take(folder.path / "none" / "lock", error));
  CHECK(error);
  CHECK(lock.take(folder.path / "lock", error));
  system::FileLock other;
  CHECK(!other.take(folder.path / "lock", error));
  CHECK(!error);
  lock.release();
  CHECK(other.take(folder.path / "lock", error));
}
