/// \file
/// Arrays of numbers as bytes, for any transport.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <powercell/error.hpp>
#include <span>
#include <type_traits>
#include <vector>

namespace powercell {

/// Bytes of an array.
template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

/// What travels.
using Bytes = std::vector<std::byte>;

/// Arrays one after the other, each behind its length.
template <class... T>
Bytes packed(const std::vector<T>&... arrays) {
  static_assert((std::is_trivially_copyable_v<T> && ...));
  Bytes bytes((0 + ... + (sizeof(std::uint64_t) + bytes_of(arrays))));
  std::byte* at = bytes.data();
  const auto put = [&at](const void* from, std::size_t count) {
    if (count > 0) std::memcpy(at, from, count);
    at += count;
  };
  const auto put_array = [&put](const auto& values) {
    const std::uint64_t count = values.size();
    put(&count, sizeof count);
    put(values.data(), bytes_of(values));
  };
  (put_array(arrays), ...);
  return bytes;
}

/// Reads what packed() wrote of as many arrays of the same types.
/// \throw Error internal
template <class... T>
void unpack(std::span<const std::byte> bytes, std::vector<T>&... arrays) {
  const auto take = [&bytes](void* to, std::uint64_t count, std::size_t size) {
    if (count > bytes.size() / size)
      throw Error(ErrorCode::internal, "a message is cut off; please report it");
    if (count > 0) std::memcpy(to, bytes.data(), count * size);
    bytes = bytes.subspan(count * size);
  };
  const auto take_array = [&]<class Value>(std::vector<Value>& values) {
    std::uint64_t count = 0;
    take(&count, 1, sizeof count);
    if (count <= bytes.size() / sizeof(Value)) values.resize(count);
    take(values.data(), count, sizeof(Value));
  };
  (take_array(arrays), ...);
  if (!bytes.empty()) throw Error(ErrorCode::internal, "a message is too long; please report it");
}

}  // namespace powercell
