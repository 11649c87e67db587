#include "lib/out_of_core/files.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
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

std::string hint(const std::error_code& error) {
  if (system::is_full(error)) return "; free some space and run it again: what is finished is kept";
  if (error == std::errc::permission_denied || error == std::errc::read_only_file_system)
    return "; choose a folder with write permission";
  if (error == std::errc::too_many_files_open) return "; allow more open files (ulimit -n)";
  return "";
}

[[noreturn]] void refuse(const std::string& path, const char* doing, const std::error_code& error) {
  throw Error(ErrorCode::write_failed, path + ": cannot " + doing + " it: " + error.message() + hint(error));
}

std::error_code last_error() {
  return {errno, std::generic_category()};
}

}  // namespace

FileWriter::FileWriter(std::string path, Kind kind)
    : path_(std::move(path)), unfinished_(kind == Kind::kept ? path_ + unfinished_end : path_), kind_(kind) {
  std::error_code error;
  file_.reset(system::create_file(unfinished_, error));
  if (error) refuse(path_, "create", error);
  (void)std::setvbuf(file_.get(), nullptr, _IOFBF, buffer_bytes);
}

void FileWriter::write_bytes(const void* from, std::size_t count) {
  if (count > 0 && std::fwrite(from, 1, count, file_.get()) != count) refuse(path_, "write", last_error());
  bytes_ += count;
}

void FileWriter::sync() {
  std::error_code error;
  system::write_to_disk(file_.get(), error);
  if (error) refuse(path_, "write", error);
}

void FileWriter::close() {
  if (kind_ == Kind::kept) sync();
  if (std::fclose(file_.release()) != 0)
    refuse(path_, "write", last_error());  // what is left of a scratch file
  if (kind_ == Kind::scratch) return;
  std::error_code error;
  fs::rename(unfinished_, path_, error);
  if (error) refuse(path_, "rename", error);
}

MappedFile::MappedFile(const std::string& path) : path_(path) {
  std::error_code error;
  bytes_ = system::map_file(path, error);
  if (error) throw Error(ErrorCode::invalid_file, path + ": cannot read it: " + error.message());
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : path_(std::move(other.path_)), bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

MappedFile::~MappedFile() {
  system::unmap(bytes_);
}

void MappedFile::drop() const {
  system::drop(bytes_);
}

void MappedFile::require(std::size_t offset, std::size_t count, std::size_t size) const {
  if (offset <= bytes() && count <= (bytes() - offset) / size) return;
  throw Error(ErrorCode::invalid_file,
              path_ + ": is shorter than what was written; remove its folder to begin anew");
}

LockedFolder::LockedFolder(std::string path) : path_(std::move(path)) {
  std::error_code error;
  fs::remove_all(path_ + finished, error);  // of a run that ended while it removed its folder
  fs::create_directories(path_, error);
  if (error) refuse(path_, "make", error);
  // A process that was killed while it started another, as compilers are, keeps it until that one has begun.
  for (int attempt = 0; attempt < 20; ++attempt) {
    if (lock_.take(file(lock_name), error)) return;
    if (error) refuse(file(lock_name), "create", error);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  throw Error(ErrorCode::write_failed,
              path_ + ": another process computes in this folder; wait for its end, or stop it");
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
  const bool again = static_cast<bool>(error);
  lock_.release();
  if (again) fs::rename(path_, path_ + finished, error);  // Windows renames no folder with an open file
  if (!error) fs::remove_all(path_ + finished, error);
  if (error) refuse(path_, "remove", error);
}

}  // namespace powercell::out_of_core
