/// \file
/// Transfers between host and device that do not wait one by one.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "lib/cl/context.hpp"

namespace powercell::cl {

class RawBuffer;

/// Host memory of a write that the queue has not yet done. The next write of the same buffer waits for it. If
/// the write fails, the next wait for results says so (Context::check_writes), if the buffer still exists: it
/// must, until results made from it are read.
class StagedWrite {
 public:
  /// Larger writes are not staged: copying costs more than waiting then.
  static constexpr std::size_t most_bytes = std::size_t{1} << 17;

  StagedWrite() = default;
  StagedWrite(StagedWrite&&) noexcept = default;
  StagedWrite& operator=(StagedWrite&& other) noexcept;
  ~StagedWrite();

  /// Memory for `bytes` bytes to be written.
  /// \throw Error opencl if the write before failed
  std::byte* stage(std::size_t bytes);
  /// Enqueues the write of the staged bytes, without waiting.
  void enqueue(Context& context, cl_mem memory, std::size_t offset);

 private:
  /// Ends the use of the bytes, whatever became of the write.
  void settle();
  std::vector<std::byte> bytes_;
  std::shared_ptr<const Event> write_;  // null if there is none
};

/// Reads that are enqueued one after the other and waited for together.
class Reads {
 public:
  explicit Reads(std::shared_ptr<Context> context) : context_(std::move(context)) {}
  Reads(const Reads&) = delete;
  Reads& operator=(const Reads&) = delete;
  ~Reads();  ///< waits, so that nothing is written to host memory afterwards

  /// \param to  must stay until wait() or the end of this object.
  /// \throw Error opencl
  void add(const RawBuffer& from, void* to, std::size_t bytes);
  void add(cl_mem from, void* to, std::size_t bytes);
  /// \throw Error opencl
  void wait();

 private:
  std::shared_ptr<Context> context_;
  std::unique_ptr<const Event> last_;  // of the reads; null if there are none to wait for
};

}  // namespace powercell::cl
