/// \file
/// Files and refusals for the tests of the readers.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <powercell/error.hpp>
#include <string>

#include "apps/io/read/file.hpp"
#include "apps/io/read/polygons.hpp"

namespace powercell::io::test {

/// A file of tests/readers/data/.
inline std::string data(const std::string& name) {
  return (std::filesystem::path(POWERCELL_READERS_DATA) / name).string();
}
inline std::string data_bytes(const std::string& name) {
  return read_file(data(name));
}

/// A new folder that is removed with its content.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "powercell_readers_XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

/// The error that `call` throws, as "code: message"; "nothing" if it does not throw.
inline std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::string(name(error.code())) + ": " + error.what();
  }
  return "nothing";
}

inline bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

inline double ring_area(const Ring& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto &a = ring[k], &b = ring[(k + 1) % ring.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice < 0 ? -twice / 2 : twice / 2;
}

inline double area(const std::vector<PolygonPart>& parts) {
  double sum = 0;
  for (const PolygonPart& part : parts) {
    sum += ring_area(part.outer);
    for (const Ring& hole : part.holes) sum -= ring_area(hole);
  }
  return sum;
}

}  // namespace powercell::io::test
