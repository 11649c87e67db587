#include "lib/out_of_core/files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <powercell/error.hpp>
#include <thread>
#include <utility>

namespace powercell::out_of_core {
namespace {

namespace fs = std::filesystem;

constexpr const char* finished = ".finished";  // the end of the name of a folder that is removed
constexpr const char* lock_name = "lock";
constexpr const char* unfinished_end = ".unfinished";  // of the name of a file that is not whole yet
constexpr std::size_t buffer_bytes = std::size_t{1} << 16;

std::string hint(int error) {
  if (error == ENOSPC || error == EDQUOT)
    return "; free some space and run it again: what is finished is kept";
  if (error == EACCES || error == EROFS) return "; choose a folder with write permission";
  if (error == EMFILE) return "; allow more open files (ulimit -n)";
  return "";
}

[[noreturn]] void refuse(const std::string& path, const char* doing, int error) {
  throw Error(ErrorCode::write_failed,
              path + ": cannot " + doing + " it: " + std::strerror(error) + hint(error));
}

}  // namespace

FileWriter::FileWriter(std::string path, Kind kind)
    : path_(std::move(path)), unfinished_(kind == Kind::kept ? path_ + unfinished_end : path_), kind_(kind) {
  file_.reset(std::fopen(unfinished_.c_str(), "wbe"));
  if (!file_) fail("create", errno);
  (void)std::setvbuf(file_.get(), nullptr, _IOFBF, buffer_bytes);
}

void FileWriter::write_bytes(const void* from, std::size_t count) {
  if (count > 0 && std::fwrite(from, 1, count, file_.get()) != count) fail("write", errno);
  bytes_ += count;
}

void FileWriter::sync() {
  if (std::fflush(file_.get()) != 0 || fsync(fileno(file_.get())) != 0) fail("write", errno);
}

void FileWriter::close() {
  if (kind_ == Kind::kept) sync();
  if (std::fclose(file_.release()) != 0) fail("write", errno);  // what is left of a scratch file
  if (kind_ == Kind::scratch) return;
  if (std::rename(unfinished_.c_str(), path_.c_str()) != 0) fail("rename", errno);
}

void FileWriter::fail(const char* doing, int error) const {
  refuse(path_, doing, error);
}

MappedFile::MappedFile(const std::string& path) : path_(path) {
  const auto fail = [&](int error) {
    throw Error(ErrorCode::invalid_file, path + ": cannot read it: " + std::strerror(error));
  };
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(errno);
  struct stat status {};
  if (fstat(file, &status) != 0) {
    const int error = errno;
    ::close(file);
    fail(error);
  }
  bytes_ = static_cast<std::size_t>(status.st_size);
  void* const data = bytes_ == 0 ? nullptr : mmap(nullptr, bytes_, PROT_READ, MAP_SHARED, file, 0);
  const int error = errno;
  ::close(file);
  if (data == MAP_FAILED) fail(error);
  data_ = static_cast<const std::byte*>(data);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : path_(std::move(other.path_)),
      data_(std::exchange(other.data_, nullptr)),
      bytes_(std::exchange(other.bytes_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(const_cast<std::byte*>(data_), bytes_);
}

void MappedFile::drop() const {
  if (data_ != nullptr) (void)madvise(const_cast<std::byte*>(data_), bytes_, MADV_DONTNEED);
}

void MappedFile::require(std::size_t offset, std::size_t count, std::size_t size) const {
  if (offset <= bytes_ && count <= (bytes_ - offset) / size) return;
  throw Error(ErrorCode::invalid_file,
              path_ + ": is shorter than what was written; remove its folder to begin anew");
}

LockedFolder::LockedFolder(std::string path) : path_(std::move(path)) {
  std::error_code error;
  fs::remove_all(path_ + finished, error);  // of a run that ended while it removed its folder
  fs::create_directories(path_, error);
  if (error) refuse(path_, "make", error.value());
  lock_ = open(file(lock_name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0) refuse(file(lock_name), "create", errno);
  // A process that was killed while it started another, as compilers are, keeps it until that one has begun.
  for (int attempt = 0; attempt < 20; ++attempt) {
    if (flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ::close(lock_);
  throw Error(ErrorCode::write_failed,
              path_ + ": another process computes in this folder; wait for its end, or stop it");
}

LockedFolder::~LockedFolder() {
  if (lock_ >= 0) ::close(lock_);
}

bool LockedFolder::has(const std::string& name) const {
  std::error_code ignored;
  return fs::exists(file(name), ignored);
}

bool LockedFolder::is_empty(const std::string& unfinished) const {
  const fs::directory_iterator files(path_);
  return std::all_of(begin(files), end(files), [&](const fs::directory_entry& entry) {
    const fs::path name = entry.path().filename();
    return name == lock_name || name == unfinished + unfinished_end;
  });
}

void LockedFolder::remove_file(const std::string& name) const {
  std::error_code ignored;  // what is left is removed with the folder
  fs::remove(file(name), ignored);
}

void LockedFolder::remove() {
  // At once, so that what is left by a process that is killed is not taken for a computation to go on with.
  std::error_code error;
  fs::rename(path_, path_ + finished, error);
  if (!error) fs::remove_all(path_ + finished, error);
  if (error) refuse(path_, "remove", error.value());
}

}  // namespace powercell::out_of_core
