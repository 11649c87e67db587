/// \file
/// A file that appears whole or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace powercell::io {

/// Writes beside the target and renames on `commit()`, so that a reader never sees half a file and a
/// failure leaves an older file of that name as it was. A target that is no regular file (a pipe, a
/// terminal, /dev/null) is written directly.
class AtomicFile {
 public:
  /// \throw Error write_failed if nothing can be created there
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Without `commit()` the unfinished file is removed.
  ~AtomicFile();

  /// \throw Error write_failed (disk full and the like), here or at `commit()`
  void write(std::string_view bytes);
  void write(char c) { write(std::string_view(&c, 1)); }
  /// The shortest decimal that reads back as the same double; "nan", "inf" as they are.
  void number(double value);
  void number(std::uint64_t value);
  /// Writes what is left and gives the file its name. \throw Error write_failed
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(const char* doing, int error) const;

  std::string path_;       // as the caller said it, for messages
  std::string target_;     // symbolic links resolved
  std::string temporary_;  // empty when written directly
  std::string buffer_;
  int file_ = -1;
  int slot_ = -1;
};

/// Refuses, before what is to be written is computed, what an AtomicFile would refuse when it is made; leaves
/// nothing. A pipe or terminal passes: at its other end it must not be seen opened and closed.
/// \throw Error write_failed
void check_can_create(const std::string& path);

/// Removes the unfinished files of this process; for a signal handler (async-signal-safe).
void remove_unfinished_files() noexcept;

}  // namespace powercell::io
