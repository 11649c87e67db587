/// \file
/// What the tests of the device layer share.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <powercell/device.hpp>
#include <string>

#include "lib/cl/program_build.hpp"
#include "tests/support/environment.hpp"

using powercell::test::Environment;

/// The device under test (POWERCELL_DEVICE, or the default one), chosen once. Never released: at the end of
/// the process the driver may be gone before it (oclgrind is).
inline const powercell::Device& test_device() {
  static const auto* device = new powercell::Device(powercell::Device::choose());
  return *device;
}

inline powercell::cl::ProgramRequest test_request(const std::string& source) {
  return {"kernels/test.cl", source, powercell::cl::build_options({"TEST=1"})};
}

/// A program that is not among the embedded ones.
inline std::shared_ptr<const powercell::cl::Program> source_program(
    const std::shared_ptr<powercell::cl::Context>& context, const std::string& source) {
  return powercell::cl::build_program(*context, test_request(source), nullptr, nullptr);
}

/// The error that `call` throws; none if it does not.
template <class Call>
std::optional<powercell::Error> error_of(Call&& call) {
  try {
    call();
  } catch (const powercell::Error& error) {
    return error;
  }
  return std::nullopt;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
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

/// A shell command that runs the skipped test case `name` of this executable in a process of its own.
inline std::string child_command(const std::string& name) {
  std::string command = std::filesystem::read_symlink("/proc/self/exe").string();
  command.insert(command.begin(), '\'');
  return command.append("' --no-skip -tc='").append(name).append("' > /dev/null");
}
