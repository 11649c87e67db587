/// \file
/// What the tests of the device layer share.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <powercell/device.hpp>
#include <string>

#include "lib/cl/program_build.hpp"

/// The device under test (POWERCELL_DEVICE, or the default one), chosen once.
inline const powercell::Device& test_device() {
  static const powercell::Device device = powercell::Device::choose();
  return device;
}

inline std::shared_ptr<const powercell::cl::Program> source_program(
    const std::shared_ptr<powercell::cl::Context>& context, const std::string& source) {
  const powercell::cl::ProgramRequest request{"test.cl", source, powercell::cl::build_options({})};
  return powercell::cl::build_program(*context, request, nullptr, nullptr);
}

/// A new empty folder, removed with what is in it at the end of the scope.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "powercell-test-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};
