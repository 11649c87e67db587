/// \file
/// A file that is looked at piece by piece.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace powercell::io {

/// The bytes of a regular file, mapped into memory.
class MappedBytes {
 public:
  /// \throw Error invalid_file (missing, not a regular file, unreadable, empty)
  explicit MappedBytes(const std::string& path);
  MappedBytes(const MappedBytes&) = delete;
  MappedBytes& operator=(const MappedBytes&) = delete;
  ~MappedBytes();

  std::string_view bytes() const { return {data_, size_}; }
  /// Gives memory back; what is looked at again is read again.
  void drop() const;
  /// Its path, size and time of change: the same as long as nobody writes to it.
  const std::string& stamp() const { return stamp_; }

 private:
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::string stamp_;
};

/// The same of a file of this path at present.
/// \throw Error invalid_file
std::string stamp_of(const std::string& path);

}  // namespace powercell::io
