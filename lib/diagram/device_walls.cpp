#include "lib/diagram/device_walls.hpp"

namespace powercell {
namespace {

constexpr const char* file = "diagram/walls.cl";

}  // namespace

DeviceWalls::DeviceWalls(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines,
                         std::size_t real_bytes)
    : real_bytes_(real_bytes),
      gather_(context, context->program(file, defines), "gather_rows"),
      match_(context, context->program(file, defines), "match_rows"),
      write_(context, context->program(file, defines), "write_rows"),
      scan_(context, ExclusiveScan::Type::uint32),
      used_(context),
      piece_first_(context),
      piece_size_(context),
      neighbor_(context),
      from_(context),
      next_(context),
      image_(context),
      wall_(context),
      matched_(context),
      row_first_(context),
      row_size_(context),
      last_extra_(context) {}

void DeviceWalls::begin(std::uint32_t entries, std::uint32_t pairs, std::uint32_t n,
                        const DeviceImages* images) {
  entries_ = entries;
  images_ = images;
  image_.resize(images ? entries : 1);
  used_.resize(1);
  used_.zero();
  for (cl::Buffer<std::uint32_t>* by_pair : {&piece_first_, &piece_size_}) by_pair->resize(pairs);
  for (cl::Buffer<std::uint32_t>* by_entry : {&neighbor_, &from_, &next_}) by_entry->resize(entries);
  for (cl::RawBuffer* by_entry : {&wall_, &matched_}) by_entry->reserve(entries * real_bytes_);
  for (cl::Buffer<std::uint32_t>* by_seed : {&row_first_, &row_size_, &last_extra_}) by_seed->resize(n);
}

void DeviceWalls::begin_without() {
  if (used_.size() == 0) begin(1, 1, 1, nullptr);  // kernels need some buffer
  entries_ = 0;
}

void DeviceWalls::append_store(cl::Kernel& kernel) const {
  kernel.more_args(entries_, used_, piece_first_, piece_size_, neighbor_, wall_);
}

void DeviceWalls::gather(const DeviceSeeds& seeds, const DevicePairs& pairs, cl_mem pair_status,
                         std::uint32_t n, const DeviceAdjacency& to) {
  const cl_mem none = used_.handle();  // kernels need some buffer
  gather_
      .args(n, seeds.order, pairs.offset, cl_ulong{pairs.capacity}, pair_status, piece_first_, piece_size_,
            entries_, used_, neighbor_, wall_, cl_int{images_ != nullptr}, image_,
            images_ ? images_->image_seed.handle() : none, images_ ? images_->image_shift.handle() : none,
            row_first_, row_size_, last_extra_, to.offset)
      .submit(std::size_t{n} + 1);
}

void DeviceWalls::write(const DeviceSeeds& seeds, cl_mem status, cl_mem frame, std::uint32_t n,
                        const DeviceAdjacency& to, std::uint32_t capacity, cl_event* done) {
  match_
      .args(n, status, row_first_, row_size_, neighbor_, wall_, cl_int{images_ != nullptr}, image_, matched_,
            from_, next_, last_extra_, to.offset)
      .submit(n);
  scan_.enqueue(to.offset, n + 1);
  const cl_mem none = used_.handle();
  write_
      .args(n, status, row_first_, row_size_, neighbor_, cl_int{images_ != nullptr}, image_,
            images_ ? images_->shift_given.handle() : none, images_ ? seeds.wrap->shift.handle() : none,
            matched_, from_, next_, last_extra_, frame, to.offset, capacity, to.neighbor, to.wall,
            images_ ? to.shift : none)
      .submit(n, 0, done);
}

}  // namespace powercell
