/// \file
/// Files of numbers: written once from front to end, then mapped into memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

#include "lib/base/system.hpp"

namespace powercell::out_of_core {

/// Writes a file. It has another name until close() where it is to be whole or not there.
class FileWriter {
 public:
  enum class Kind {
    scratch,  ///< worth nothing after a crash
    kept,     ///< there as a whole or not at all, also after a crash of the machine
  };
  /// \throw Error write_failed
  FileWriter(std::string path, Kind kind);
  FileWriter(FileWriter&&) = default;
  FileWriter& operator=(FileWriter&&) = default;

  /// \throw Error write_failed (disk full and the like), here or at close()
  template <class Array>
  void write_all(const Array& values) {
    static_assert(std::is_trivially_copyable_v<std::remove_cvref_t<decltype(*values.data())>>);
    write_bytes(values.data(), values.size() * sizeof(*values.data()));
  }
  template <class T>
  void write_one(const T& value) {
    write_all(std::span(&value, 1));
  }
  /// Waits until the disk has what was written so far, so that close() has less to wait for.
  void sync();
  void close();
  std::uint64_t bytes() const { return bytes_; }

 private:
  void write_bytes(const void* from, std::size_t count);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_, unfinished_;
  Kind kind_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t bytes_ = 0;
};

/// A file in memory, as far as it is looked at.
class MappedFile {
 public:
  MappedFile() = default;
  /// \throw Error invalid_file
  explicit MappedFile(const std::string& path);
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  std::size_t bytes() const { return bytes_.size(); }
  /// Numbers from a byte on; its offset must be a multiple of their size.
  /// \throw Error invalid_file if the file ends before them
  template <class T>
  std::span<const T> numbers(std::size_t offset, std::size_t count) const {
    require(offset, count, sizeof(T));
    return {reinterpret_cast<const T*>(bytes_.data() + offset), count};
  }
  /// All of the file.
  template <class T>
  std::span<const T> all() const {
    return numbers<T>(0, bytes() / sizeof(T));
  }
  /// Gives the memory back; what is looked at again is read again.
  void drop() const;

 private:
  void require(std::size_t offset, std::size_t count, std::size_t size) const;

  std::string path_;
  std::span<const std::byte> bytes_;
};

/// A folder of which one process makes use at a time.
class LockedFolder {
 public:
  /// Makes the folder if it is not there.
  /// \throw Error write_failed (it cannot be made; another process has it)
  explicit LockedFolder(std::string path);
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;

  std::string file(const std::string& name) const { return path_ + "/" + name; }
  bool has(const std::string& name) const;
  /// But for the lock, and for what a FileWriter that was killed has left of the file of that name.
  bool is_empty(const std::string& unfinished) const;
  void remove_file(const std::string& name) const;
  /// With all that is in it.
  /// \throw Error write_failed
  void remove();

 private:
  std::string path_;
  system::FileLock lock_;
};

}  // namespace powercell::out_of_core
