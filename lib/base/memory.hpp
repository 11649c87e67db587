/// \file
/// Large arrays in host memory.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace powercell {

/// Makes the system map the pages of memory that is about to be written, on all threads at once; otherwise
/// the thread that writes it first waits for one page after the other. Does nothing on systems that cannot.
void populate(void* begin, std::size_t bytes, int threads);

/// Resizes an array that may become large, populating its new pages on all threads.
template <class T>
void resize_populated(std::vector<T>& values, std::size_t count, int threads, const T& value = {}) {
  values.reserve(count);
  if (count > values.size())
    populate(values.data() + values.size(), (count - values.size()) * sizeof(T), threads);
  values.resize(count, value);
}

/// An array that grows without writing its new elements, and without a second copy of itself where the system
/// can move pages (realloc).
template <class T>
class GrowingArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  GrowingArray() = default;
  GrowingArray(GrowingArray&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~GrowingArray() { std::free(data_); }

  /// Values beyond the old size are undefined.
  /// \throw std::bad_alloc
  /// \param factor  capacity over size if the array must be reallocated
  void resize(std::size_t size, double factor = 1.25) {
    if (size > capacity_) grow(static_cast<std::size_t>(static_cast<double>(size) * factor) + 1);
    size_ = size;
  }
  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return capacity_ * sizeof(T); }

 private:
  void grow(std::size_t capacity) {
    void* grown = std::realloc(data_, capacity * sizeof(T));
    if (!grown) throw std::bad_alloc();
    data_ = static_cast<T*>(grown);
    capacity_ = capacity;
  }
  T* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace powercell
