#include "apps/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <powercell/error.hpp>

namespace powercell::io {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;

// Names of unfinished files in fixed memory without locks, for a signal handler.
struct Slot {
  std::atomic<bool> taken{false};
  std::atomic<bool> filled{false};
  std::array<char, PATH_MAX> path{};
};
std::array<Slot, 16> slots;

int remember(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].taken.exchange(true)) continue;
    std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
    slots[i].filled = true;
    return static_cast<int>(i);
  }
  return -1;  // more open files than slots: a signal would leave this one behind
}

void forget(int slot) {
  if (slot < 0) return;
  slots[static_cast<std::size_t>(slot)].filled = false;
  slots[static_cast<std::size_t>(slot)].taken = false;
}

int kept_output = -1;  // the standard output, once reserved

std::string resolve_links(const std::string& path) {
  std::error_code ignored;
  const auto resolved = std::filesystem::weakly_canonical(path, ignored);
  return ignored || resolved.empty() ? path : resolved.string();
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(resolve_links(path)) {
  if (is_standard_output(path)) {
    file_ = fcntl(kept_output >= 0 ? kept_output : STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
    if (file_ < 0) fail("open", errno);
    return;
  }
  struct stat old {};
  const bool exists = stat(path.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) fail("open", EISDIR);
  if (exists && !S_ISREG(old.st_mode)) {
    file_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0) fail("open", errno);
    return;
  }
  static std::atomic<unsigned> serial{0};
  const std::filesystem::path target(target_);
  const std::string name =
      "." + target.filename().string() + "." + std::to_string(getpid()) + "-" + std::to_string(serial++);
  temporary_ = (target.parent_path() / name).string();
  slot_ = remember(temporary_);
  file_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0) {
    const int error = errno;
    forget(slot_);
    fail("create", error);
  }
  if (exists) (void)fchmod(file_, old.st_mode & 07777);  // best effort
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) close(file_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
  forget(slot_);
}

void AtomicFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > buffer_size) flush();
  if (buffer_.capacity() < buffer_size) buffer_.reserve(buffer_size);
  buffer_.append(bytes);
}

void AtomicFile::number(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  write(std::string_view(text.data(), static_cast<std::size_t>(end - text.data())));
}

void AtomicFile::number(std::uint64_t value) {
  std::array<char, 24> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  write(std::string_view(text.data(), static_cast<std::size_t>(end - text.data())));
}

void AtomicFile::flush() {
  const char* next = buffer_.data();
  std::size_t left = buffer_.size();
  while (left > 0) {
    const ssize_t written = ::write(file_, next, left);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EPIPE && temporary_.empty()) break;  // the reader has what it wants
    if (written < 0) fail("write", errno);
    next += written;
    left -= static_cast<std::size_t>(written);
  }
  buffer_.clear();
}

void AtomicFile::commit() {
  flush();
  const int file = file_;
  file_ = -1;
  if (close(file) != 0) fail("close", errno);
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail("rename", errno);
  temporary_.clear();
  forget(slot_);
  slot_ = -1;
}

void AtomicFile::fail(const char* doing, int error) const {
  std::string hint;
  if (error == ENOENT) hint = "; does its folder exist?";
  if (error == ENOSPC || error == EDQUOT) hint = "; free some space or write elsewhere";
  if (error == EACCES || error == EROFS) hint = "; choose a folder with write permission";
  throw Error(ErrorCode::write_failed, path_ + ": cannot " + doing + " it: " + std::strerror(error) + hint);
}

bool is_standard_output(const std::string& path) {
  return path == "-";
}

void reserve_standard_output() {
  if (kept_output >= 0) return;
  std::fflush(stdout);
  kept_output = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (kept_output < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
    throw Error(ErrorCode::write_failed,
                std::string("standard output: cannot be written: ") + std::strerror(errno));
}

void check_can_create(const std::string& path) {
  if (is_standard_output(path)) return;
  struct stat old {};
  const bool exists = stat(path.c_str(), &old) == 0;
  if (!exists || S_ISREG(old.st_mode) || S_ISDIR(old.st_mode)) AtomicFile{path};
}

void remove_unfinished_files() noexcept {
  for (auto& slot : slots) {
    if (slot.filled) unlink(slot.path.data());
  }
}

}  // namespace powercell::io
