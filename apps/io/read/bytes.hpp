/// \file
/// Numbers of a binary file in memory, in either byte order.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "apps/io/read/file.hpp"

namespace powercell::io {

/// The types of numbers in binary files.
enum class NumberType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

/// Calls `take` with a zero of the C++ type for `type`.
template <class Take>
auto with_number_type(NumberType type, Take take) {
  switch (type) {
    case NumberType::i8:
      return take(std::int8_t{});
    case NumberType::u8:
      return take(std::uint8_t{});
    case NumberType::i16:
      return take(std::int16_t{});
    case NumberType::u16:
      return take(std::uint16_t{});
    case NumberType::i32:
      return take(std::int32_t{});
    case NumberType::u32:
      return take(std::uint32_t{});
    case NumberType::i64:
      return take(std::int64_t{});
    case NumberType::u64:
      return take(std::uint64_t{});
    case NumberType::f32:
      return take(float{});
    case NumberType::f64:
      break;
  }
  return take(double{});
}

inline std::size_t size_of(NumberType type) {
  return with_number_type(type, [](auto number) { return sizeof(number); });
}

/// The number at `bytes`, not aligned; `swapped` if its byte order is not the machine's.
template <class Number>
Number load_number(const char* bytes, bool swapped) {
  char own[sizeof(Number)];
  std::memcpy(own, bytes, sizeof(Number));
  if (swapped) std::reverse(own, own + sizeof(Number));
  Number value;
  std::memcpy(&value, own, sizeof(Number));
  return value;
}

/// The same for a type known at run time, rounded to a double.
inline double load_number(const char* bytes, NumberType type, bool swapped) {
  return with_number_type(
      type, [&](auto number) { return static_cast<double>(load_number<decltype(number)>(bytes, swapped)); });
}

inline bool swapped_from(std::endian order) {
  return order != std::endian::native;
}

/// Reads numbers one after the other. Failures are Error invalid_file "NAME: at byte N: ...".
class ByteScanner {
 public:
  ByteScanner(std::string_view bytes, std::string name, std::endian order, std::size_t at = 0)
      : bytes_(bytes), name_(std::move(name)), swapped_(swapped_from(order)), at_(at) {}

  template <class Number>
  Number next(const char* what) {
    need(1, sizeof(Number), what);
    const Number value = load_number<Number>(bytes_.data() + at_, swapped_);
    at_ += sizeof(Number);
    return value;
  }

  /// The same for a type known at run time, rounded to a double.
  /// \param what  the item, for messages
  double next(NumberType type, const char* what) {
    return with_number_type(type,
                            [&](auto number) { return static_cast<double>(next<decltype(number)>(what)); });
  }

  /// Refuses unless `count` items of `size` bytes are left.
  void need(std::uint64_t count, std::size_t size, const char* what) const {
    const std::size_t left = at_ < bytes_.size() ? bytes_.size() - at_ : 0;
    if (size != 0 && count > left / size) {
      fail(fmt::format(
          "the file ends in {}: {} of {} bytes are needed and {} bytes are left; it is truncated or the "
          "count is wrong",
          what, count, size, left));
    }
  }

  void skip(std::uint64_t count, std::size_t size, const char* what) {
    need(count, size, what);
    at_ += static_cast<std::size_t>(count) * size;
  }

  std::size_t offset() const { return at_; }
  void seek(std::size_t offset) { at_ = offset; }
  [[noreturn]] void fail(const std::string& what) const {
    fail_file(name_, fmt::format("at byte {}: {}", at_, what));
  }

 private:
  std::string_view bytes_;
  std::string name_;
  bool swapped_;
  std::size_t at_;
};

}  // namespace powercell::io
