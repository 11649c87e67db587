#include "lib/cl/transfers.hpp"

#include <utility>

#include "lib/cl/buffer.hpp"
#include "lib/cl/errors.hpp"

namespace powercell::cl {

StagedWrite& StagedWrite::operator=(StagedWrite&& other) noexcept {
  if (this == &other) return *this;
  settle();
  bytes_ = std::move(other.bytes_);
  write_ = std::move(other.write_);
  return *this;
}

StagedWrite::~StagedWrite() {
  settle();
}

void StagedWrite::settle() {
  if (!write_) return;
  // A driver that cannot even say when it is done keeps the bytes for ever.
  if (write_->state() > CL_COMPLETE && write_->wait() != CL_SUCCESS && write_->is_pending())
    new std::vector<std::byte>(std::move(bytes_));
  write_.reset();
}

std::byte* StagedWrite::stage(std::size_t bytes) {
  if (write_) check(write_->wait(), "writing " + std::to_string(bytes_.size()) + " bytes to a device");
  write_.reset();
  bytes_.resize(bytes);
  return bytes_.data();
}

void StagedWrite::enqueue(Context& context, cl_mem memory, std::size_t offset) {
  cl_event done = nullptr;
  check(clEnqueueWriteBuffer(context.queue(), memory, CL_FALSE, offset, bytes_.size(), bytes_.data(), 0,
                             nullptr, &done),
        "writing " + std::to_string(bytes_.size()) + " bytes to " + context.info().name);
  write_ = std::make_shared<const Event>(done);
  context.note_write(write_);
}

Reads::~Reads() {
  if (last_ && last_->wait() != CL_SUCCESS) last_->is_pending();
}

void Reads::add(const RawBuffer& from, void* to, std::size_t bytes) {
  if (bytes > 0) from.require_inside(0, bytes);
  add(from.handle(), to, bytes);
}

void Reads::add(cl_mem from, void* to, std::size_t bytes) {
  if (bytes == 0) return;
  cl_event done = nullptr;
  check(clEnqueueReadBuffer(context_->queue(), from, CL_FALSE, 0, bytes, to, 0, nullptr, &done),
        "reading " + std::to_string(bytes) + " bytes from " + context_->info().name);
  last_ = std::make_unique<const Event>(done);
}

void Reads::wait() {
  if (!last_) return;
  check(last_->wait(), "reading from " + context_->info().name);
  last_.reset();
  context_->check_writes();
}

}  // namespace powercell::cl
