// Every kept input of every target once more: what the fuzzers started from, and what they found.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/targets.hpp"

using namespace powercell::fuzz;

namespace {

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("the corpora") {
  for (const Target& target : kTargets) {
    CAPTURE(std::string(target.name));
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(
             std::filesystem::path(POWERCELL_FUZZ_FOLDER) / "corpus" / target.name))
      files.push_back(entry.path());
    std::ranges::sort(files);
    CHECK(files.size() >= 3);
    for (const auto& file : files) {
      CAPTURE(file.filename().string());
      const std::vector<std::uint8_t> bytes = bytes_of(file);
      try {
        target.run(bytes);
        CHECK(true);
      } catch (const std::exception& error) {
        FAIL_CHECK(std::string(error.what()));
      }
    }
  }
}

TEST_CASE("no input, and one byte") {
  for (const Target& target : kTargets) {
    CAPTURE(std::string(target.name));
    CHECK_NOTHROW(target.run({}));
    const std::vector<std::uint8_t> byte{0};
    CHECK_NOTHROW(target.run(byte));
  }
}
