#if !defined(_WIN32)

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "lib/base/system.hpp"

namespace powercell::system {
namespace {

namespace fs = std::filesystem;

std::error_code reason(int error) {
  return {error, std::generic_category()};
}

}  // namespace

std::string process_number() {
  return std::to_string(getpid());
}

fs::path path_from_environment(const char* variable) {
  const char* const value = std::getenv(variable);
  return value ? value : "";
}

fs::path cache_folder() {
  if (fs::path folder = path_from_environment("XDG_CACHE_HOME"); !folder.empty()) return folder;
  const fs::path home = path_from_environment("HOME");
  return home.empty() ? home : home / ".cache";
}

std::FILE* create_file(const fs::path& path, std::error_code& error) {
  std::FILE* const file = std::fopen(path.c_str(), "wbe");
  error = reason(file ? 0 : errno);
  return file;
}

void write_to_disk(std::FILE* file, std::error_code& error) {
  error = reason(std::fflush(file) == 0 && fsync(fileno(file)) == 0 ? 0 : errno);
}

bool is_full(const std::error_code& error) {
  return error.value() == ENOSPC || error.value() == EDQUOT;
}

std::span<const std::byte> map_file(const fs::path& path, std::error_code& error) {
  error.clear();
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (file < 0 || fstat(file, &status) != 0) {
    error = reason(errno);
    if (file >= 0) close(file);
    return {};
  }
  const auto bytes = static_cast<std::size_t>(status.st_size);
  void* const data = bytes == 0 ? nullptr : mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file, 0);
  if (data == MAP_FAILED) error = reason(errno);
  close(file);
  if (error) return {};
  return {static_cast<const std::byte*>(data), bytes};
}

void unmap(std::span<const std::byte> bytes) noexcept {
  if (!bytes.empty()) munmap(const_cast<std::byte*>(bytes.data()), bytes.size());
}

void drop(std::span<const std::byte> bytes) noexcept {
  if (!bytes.empty()) (void)madvise(const_cast<std::byte*>(bytes.data()), bytes.size(), MADV_DONTNEED);
}

bool FileLock::take(const fs::path& path, std::error_code& error) {
  release();
  error.clear();
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) {
    error = reason(errno);
    return false;
  }
  if (flock(file, LOCK_EX | LOCK_NB) != 0) {
    close(file);
    return false;
  }
  handle_ = file;
  return true;
}

void FileLock::release() noexcept {
  if (handle_ >= 0) close(static_cast<int>(handle_));
  handle_ = -1;
}

}  // namespace powercell::system

#endif
