/// \file
/// Files, and what else POSIX and Windows do in different ways: system_posix.cpp and system_windows.cpp.
/// Paths are std::filesystem::path, which takes text as UTF-8 on Windows with GCC's library. A function with
/// `error` clears it, or says there what went wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>

namespace powercell::system {

/// A number that no other process on this machine has.
std::string process_number();

/// The path that a variable of the environment has; empty if it is not set.
std::filesystem::path path_from_environment(const char* variable);

/// The user's folder for what can be made again; empty if there is none.
std::filesystem::path cache_folder();

/// Makes an empty file to write to, which programs started meanwhile do not get. Null on failure.
std::FILE* create_file(const std::filesystem::path& path, std::error_code& error);

/// Waits until the disk has what was written to the file.
void write_to_disk(std::FILE* file, std::error_code& error);

/// Whether the disk is full, or what this user may have of it.
bool is_full(const std::error_code& error);

/// All of a file as memory, read where it is looked at.
std::span<const std::byte> map_file(const std::filesystem::path& path, std::error_code& error);
void unmap(std::span<const std::byte> bytes) noexcept;
/// Gives the memory back until it is looked at again.
void drop(std::span<const std::byte> bytes) noexcept;

/// A file that one process holds at a time: until release(), or its end.
class FileLock {
 public:
  FileLock() = default;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock() { release(); }

  /// Makes the file if it is not there. False if it cannot be made, or, without an error, if another has it.
  bool take(const std::filesystem::path& path, std::error_code& error);
  void release() noexcept;

 private:
  std::intptr_t handle_ = -1;  // of the open file
};

}  // namespace powercell::system
