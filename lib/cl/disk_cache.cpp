#include "lib/cl/disk_cache.hpp"

#include <array>
#include <atomic>
#include <bit>
#include <cstring>
#include <fstream>
#include <system_error>

#include "lib/base/system.hpp"

namespace powercell::cl {
namespace {

/// Header of a file, before the binary. Only the machine that wrote it reads it.
struct Header {
  std::array<char, 8> magic{'P', 'W', 'R', 'C', 'E', 'L', 'L', '1'};
  CacheKey key;
  std::uint64_t size = 0;      ///< of the binary, bytes
  std::uint64_t checksum = 0;  ///< FNV-1a of the binary
  friend bool operator==(const Header&, const Header&) = default;
};
static_assert(sizeof(Header) == 40, "no padding: the header is written as it lies in memory");

constexpr std::uint64_t fnv_basis = 0xcbf29ce484222325u;
constexpr std::uint64_t fnv_prime = 0x100000001b3u;

/// FNV-1a of 64 bits, and beside it a hash that mixes otherwise, so that both do not collide together.
struct Hash {
  std::uint64_t fnv = fnv_basis;
  std::uint64_t other = 0x9e3779b97f4a7c15u;
  void add(unsigned char byte) {
    fnv = (fnv ^ byte) * fnv_prime;
    other = (std::rotl(other, 23) ^ byte) * 0xbf58476d1ce4e5b9u;
  }
  template <class Bytes>
  void add_all(const Bytes& bytes) {
    for (const auto byte : bytes) add(static_cast<unsigned char>(byte));
  }
};

Header header_of(const CacheKey& key, std::span<const unsigned char> binary) {
  Hash hash;
  hash.add_all(binary);
  Header header;
  header.key = key;
  header.size = binary.size();
  header.checksum = hash.fnv;
  return header;
}

/// A name no other writer uses, in this process or another.
std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter{0};
  std::filesystem::path temporary = path;
  for (const std::string& part : {system::process_number(), std::to_string(counter++)})
    temporary += '.' + part;
  temporary += ".tmp";
  return temporary;
}

}  // namespace

bool write_whole(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) return false;
  const auto temporary = temporary_beside(path);
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  for (const std::string_view part : parts)
    file.write(part.data(), static_cast<std::streamsize>(part.size()));
  file.close();
  const bool whole = !file.fail();
  if (whole) std::filesystem::rename(temporary, path, error);
  if (whole && !error) return true;
  std::filesystem::remove(temporary, error);
  return false;
}

CacheKey CacheKey::of(std::span<const std::string_view> parts) {
  Hash hash;
  for (const auto part : parts) {
    hash.add_all(part);
    for (std::uint64_t size = part.size(), i = 0; i < 8; ++i, size >>= 8)
      hash.add(static_cast<unsigned char>(size & 0xff));
  }
  // A last mixing, since the high bits of the last bytes are still weak.
  const std::uint64_t mixed = (hash.other ^ (hash.other >> 31)) * 0x94d049bb133111ebu;
  return {mixed ^ (mixed >> 29), hash.fnv};
}

std::string CacheKey::hex() const {
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const std::uint64_t half : {high, low})
    for (int shift = 60; shift >= 0; shift -= 4) text.push_back(digits[(half >> shift) & 15]);
  return text;
}

std::filesystem::path DiskCache::default_folder() {
  if (auto own = system::path_from_environment("POWERCELL_CACHE_DIR"); !own.empty()) return own;
  const std::filesystem::path folder = system::cache_folder();
  return folder.empty() ? folder : folder / "powercell";
}

std::optional<Binary> DiskCache::read(const CacheKey& key) const {
  if (folder_.empty()) return std::nullopt;
  std::ifstream file(path(key), std::ios::binary);
  if (!file) return std::nullopt;
  Header header;
  std::error_code error;
  const std::uintmax_t file_size = std::filesystem::file_size(path(key), error);
  // The size is checked first, so that a damaged header cannot request more memory than the file has bytes.
  if (!error && file.read(reinterpret_cast<char*>(&header), sizeof header) &&
      file_size == sizeof header + header.size) {
    Binary binary(header.size);
    if (file.read(reinterpret_cast<char*>(binary.data()), static_cast<std::streamsize>(binary.size())) &&
        header == header_of(key, binary))
      return binary;
  }
  file.close();
  remove(key);
  return std::nullopt;
}

bool DiskCache::write(const CacheKey& key, std::span<const unsigned char> binary) const {
  if (folder_.empty()) return false;
  const Header header = header_of(key, binary);
  return write_whole(path(key), {{reinterpret_cast<const char*>(&header), sizeof header},
                                 {reinterpret_cast<const char*>(binary.data()), binary.size()}});
}

void DiskCache::remove(const CacheKey& key) const {
  std::error_code ignored;  // deleted already, or without permission: the next write replaces it
  std::filesystem::remove(path(key), ignored);
}

}  // namespace powercell::cl
