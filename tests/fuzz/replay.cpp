// Every kept input of every target once more: what the fuzzers started from, and what they found.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
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

/// In order of their names, so that runs are alike.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

void replay(const Target& target, const std::vector<std::filesystem::path>& files) {
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

}  // namespace

TEST_CASE("the corpora") {
  for (const Target& target : kTargets) {
    CAPTURE(std::string(target.name));
    const auto files = files_of(std::filesystem::path(POWERCELL_FUZZ_FOLDER) / "corpus" / target.name);
    CHECK(files.size() >= 3);
    replay(target, files);
  }
}

// folder.cmake has it run under the sanitizers always.
TEST_CASE("inputs that reach what fuzzing has reached" *
          doctest::skip(std::getenv("POWERCELL_TEST_ALL") == nullptr)) {
  std::size_t targets = 0;
  for (const Target& target : kTargets) {
    CAPTURE(std::string(target.name));
    const std::filesystem::path folder = std::filesystem::path(POWERCELL_FUZZ_REACHED) / target.name;
    if (!std::filesystem::exists(folder)) continue;  // of some targets none are kept yet
    ++targets;
    const auto files = files_of(folder);
    CHECK(!files.empty());
    replay(target, files);
  }
  CHECK(targets > 0);
}

TEST_CASE("no input, and one byte") {
  for (const Target& target : kTargets) {
    CAPTURE(std::string(target.name));
    CHECK_NOTHROW(target.run({}));
    const std::vector<std::uint8_t> byte{0};
    CHECK_NOTHROW(target.run(byte));
  }
}
