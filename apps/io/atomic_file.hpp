/// \file
/// A file that is replaced as a whole or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace powercell::io {

/// Writes beside the target and renames on `commit()`, so that a reader never sees half a file and a
/// failure leaves an older file of that name unchanged. A target that is not a regular file (a pipe, a
/// terminal, /dev/null; `-` for the standard output) is written directly, and a reader that closes a pipe
/// early is no failure.
class AtomicFile {
 public:
  /// \throw Error write_failed if the file cannot be created
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes the unfinished file if `commit()` was not called.
  ~AtomicFile();

  /// \throw Error write_failed (disk full and the like), here or at `commit()`
  void write(std::string_view bytes);
  void write(char c) { write(std::string_view(&c, 1)); }
  /// The shortest decimal that reads back as the same double, or "nan" or "inf".
  void number(double value);
  void number(std::uint64_t value);
  /// The bytes of a number as they are in memory.
  template <class Number>
  void raw(Number value) {
    write(std::string_view(reinterpret_cast<const char*>(&value), sizeof value));
  }
  /// Writes the rest of the buffer and gives the file its name.
  /// \throw Error write_failed
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(const char* doing, int error) const;

  std::string path_;       // as given by the caller, for messages
  std::string target_;     // symbolic links resolved
  std::string temporary_;  // empty when written directly
  std::string buffer_;
  int file_ = -1;
  int slot_ = -1;
};

/// Whether a path means the standard output: "-".
bool is_standard_output(const std::string& path);

/// Keeps the standard output for the file `-`: what is printed there from now on goes to the standard error.
/// \throw Error write_failed
void reserve_standard_output();

/// Checks before a long computation whether an AtomicFile could be created there; leaves no file. Pipes and
/// terminals are not checked, since the other end would see them opened and closed.
/// \throw Error write_failed
void check_can_create(const std::string& path);

/// Removes the unfinished files of this process; for a signal handler (async-signal-safe).
void remove_unfinished_files() noexcept;

}  // namespace powercell::io
