#include "apps/io/read/mapped_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "apps/io/read/file.hpp"

namespace powercell::io {
namespace {

std::string stamp_text(const std::string& path, const struct stat& status) {
  std::error_code ignored;
  return fmt::format("{}, {} bytes, changed at {}.{:09}",
                     std::filesystem::weakly_canonical(path, ignored).string(), status.st_size,
                     status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
}

}  // namespace

MappedBytes::MappedBytes(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail_file(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  struct stat status {};
  const bool regular = fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  size_ = regular ? static_cast<std::size_t>(status.st_size) : 0;
  void* const data = size_ == 0 ? MAP_FAILED : mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
  const int error = errno;
  close(file);
  if (!regular) fail_file(path, "is not a regular file, so it cannot be read more than once; write one");
  if (size_ == 0) fail_file(path, "is empty");
  if (data == MAP_FAILED) fail_file(path, fmt::format("cannot be read: {}", std::strerror(error)));
  data_ = static_cast<char*>(data);
  stamp_ = stamp_text(path, status);
}

MappedBytes::~MappedBytes() {
  munmap(data_, size_);
}

void MappedBytes::drop() const {
  (void)madvise(data_, size_, MADV_DONTNEED);
}

std::string stamp_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0)
    fail_file(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  return stamp_text(path, status);
}

}  // namespace powercell::io
