/// \file
/// Device memory of one element type, and kernel calls.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "lib/cl/context.hpp"
#include "lib/cl/transfers.hpp"

namespace powercell::cl {

/// Untyped device buffer. It grows on request and never shrinks; its contents are undefined after growth.
class RawBuffer {
 public:
  explicit RawBuffer(std::shared_ptr<Context> context) : context_(std::move(context)) {}
  RawBuffer(RawBuffer&& other) noexcept;
  RawBuffer& operator=(RawBuffer&& other) noexcept;
  ~RawBuffer();

  /// At least `bytes` (one element is allocated for 0).
  /// \throw Error out_of_device_memory
  void reserve(std::size_t bytes);
  /// The bytes may be changed afterwards: few are copied and the write is only enqueued, of many it waits.
  void write(const void* from, std::size_t bytes, std::size_t offset = 0);
  void read(void* to, std::size_t bytes, std::size_t offset = 0) const;  ///< waits; see also Reads
  void fill_zero(std::size_t bytes);
  /// Lets `writer` write the first `bytes` bytes, all of them; many in place where host and device share
  /// memory.
  void fill(std::size_t bytes, const std::function<void(std::byte*)>& writer);
  cl_mem handle() const { return memory_; }
  std::size_t bytes() const { return bytes_; }
  const std::shared_ptr<Context>& context() const { return context_; }
  /// \throw Error internal unless the buffer has these bytes
  void require_inside(std::size_t offset, std::size_t bytes) const;

 private:
  std::shared_ptr<Context> context_;
  cl_mem memory_ = nullptr;
  std::size_t bytes_ = 0;
  StagedWrite staged_;
};

/// The first bytes of a buffer as host memory, to be read: in place where host and device share memory. No
/// kernel may write to the buffer meanwhile.
class Mapping {
 public:
  /// \throw Error opencl, out_of_device_memory
  Mapping(const RawBuffer& buffer, std::size_t bytes);
  Mapping(Mapping&& other) noexcept;
  Mapping& operator=(Mapping&&) = delete;
  ~Mapping();

  const std::byte* data() const { return data_; }
  /// Unmaps the buffer; data() is invalid afterwards.
  /// \throw Error opencl
  void end();

 private:
  std::shared_ptr<Context> context_;
  cl_mem memory_;
  std::byte* data_ = nullptr;
};

template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit Buffer(std::shared_ptr<Context> context) : raw_(std::move(context)) {}
  void resize(std::size_t count) { raw_.reserve((size_ = count) * sizeof(T)); }
  void upload(std::span<const T> values) {
    resize(values.size());
    if (!values.empty()) raw_.write(values.data(), values.size_bytes());
  }
  void download(std::span<T> to, std::size_t first = 0) const {
    if (!to.empty()) raw_.read(to.data(), to.size_bytes(), first * sizeof(T));
  }
  std::vector<T> download() const {
    std::vector<T> out(size_);
    download(std::span<T>(out));
    return out;
  }
  void zero() { raw_.fill_zero(size_ * sizeof(T)); }
  std::size_t size() const { return size_; }
  cl_mem handle() const { return raw_.handle(); }
  const RawBuffer& raw() const { return raw_; }

 private:
  RawBuffer raw_;
  std::size_t size_ = 0;
};

}  // namespace powercell::cl
