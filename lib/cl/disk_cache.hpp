/// \file
/// Compiled programs kept between runs, a file each.
///
/// No function throws because of the disk: a cache that cannot be read or written acts as an empty one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::cl {

/// Writes `parts` one after the other beside `path`, makes its folder when needed, and renames, so that
/// readers see a whole file or none. False if it could not be written whole.
bool write_whole(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

/// 128 bits that name an entry.
struct CacheKey {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  /// Hash of the parts and of where each ends.
  static CacheKey of(std::span<const std::string_view> parts);
  std::string hex() const;  ///< 32 digits
  friend bool operator==(const CacheKey&, const CacheKey&) = default;
};

using Binary = std::vector<unsigned char>;

/// Entries in one folder. An entry is written beside its place and renamed, so that readers and other
/// writers, also in other processes, see a whole entry or none. Any number of objects may share a folder.
class DiskCache {
 public:
  /// An empty folder makes a cache that is always empty.
  explicit DiskCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// POWERCELL_CACHE_DIR, else XDG_CACHE_HOME/powercell, else HOME/.cache/powercell (on Windows
  /// LOCALAPPDATA/powercell), else empty.
  static std::filesystem::path default_folder();
  const std::filesystem::path& folder() const { return folder_; }

  /// The entry, if it exists and is intact. Deletes an entry that is truncated, altered or of another key.
  std::optional<Binary> read(const CacheKey& key) const;
  /// Makes the folder when needed. False if the entry could not be written whole.
  bool write(const CacheKey& key, std::span<const unsigned char> binary) const;
  void remove(const CacheKey& key) const;
  std::filesystem::path path(const CacheKey& key) const { return folder_ / (key.hex() + ".clbin"); }

 private:
  std::filesystem::path folder_;
};

}  // namespace powercell::cl
