#include "lib/device_diagram/walls.hpp"

#include <powercell/seeds.hpp>

#include "kernels/layout.h"

namespace powercell {
namespace {

constexpr const char* file = "device_diagram/walls.cl";
static_assert(most_seeds_of_diagram <= ENTRY_FACET);

}  // namespace

DeviceWalls::DeviceWalls(const std::shared_ptr<cl::Context>& context, const DeviceFacets& facets,
                         const std::vector<std::string>& defines, std::size_t real_bytes)
    : facets_(facets),
      real_bytes_(real_bytes),
      gather_(context, context->program(file, defines), "gather_rows"),
      match_(context, context->program(file, defines), "match_rows"),
      write_(context, context->program(file, defines), "write_rows"),
      size_facets_(context, context->program(file, defines), "size_facets"),
      write_facets_(context, context->program(file, defines), "write_facets"),
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
      facet_size_(context),
      last_extra_(context) {}

void DeviceWalls::begin(cl_uint faces, std::uint32_t entries, std::uint32_t pairs, std::uint32_t n,
                        const DeviceImages* images) {
  faces_ = faces;
  entries_ = entries;
  images_ = images;
  image_.resize(images ? entries : 1);
  used_.resize(1);
  used_.zero();
  for (cl::Buffer<std::uint32_t>* by_pair : {&piece_first_, &piece_size_}) by_pair->resize(pairs);
  for (cl::Buffer<std::uint32_t>* by_entry : {&neighbor_, &from_, &next_}) by_entry->resize(entries);
  for (cl::RawBuffer* by_entry : {&wall_, &matched_}) by_entry->reserve(entries * real_bytes_);
  for (cl::Buffer<std::uint32_t>* by_seed : {&row_first_, &row_size_, &facet_size_, &last_extra_})
    by_seed->resize(n);
}

void DeviceWalls::begin_without() {
  if (used_.size() == 0) begin(0, 1, 1, 1, nullptr);  // kernels need some buffer
  faces_ = 0;
}

void DeviceWalls::append_store(cl::Kernel& kernel) const {
  kernel.more_args(faces_, entries_, used_, piece_first_, piece_size_, neighbor_, wall_);
}

void DeviceWalls::gather(const DeviceSeeds& seeds, const DevicePairs& pairs, cl_mem pair_status,
                         std::uint32_t n, const DeviceAdjacency& to) {
  const cl_mem none = used_.handle();  // kernels need some buffer
  gather_
      .args(n, faces_, seeds.order, pairs.offset, cl_ulong{pairs.capacity}, pairs.region, facets_.offset,
            facets_.facet, pair_status, piece_first_, piece_size_, entries_, used_, neighbor_, wall_,
            cl_int{images_ != nullptr}, image_, images_ ? images_->image_seed.handle() : none,
            images_ ? images_->image_shift.handle() : none, row_first_, row_size_, facet_size_, last_extra_,
            to.offset ? to.offset : none)
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

void DeviceWalls::write_facets(cl_mem status, cl_mem frame, std::uint32_t n, const DeviceBoundaryWalls& to,
                               std::uint32_t capacity, cl_event* done) {
  size_facets_.args(n, status, row_first_, row_size_, facet_size_, wall_, to.offset)
      .submit(std::size_t{n} + 1);
  scan_.enqueue(to.offset, n + 1);
  write_facets_
      .args(n, status, row_first_, row_size_, facet_size_, neighbor_, wall_, frame, to.offset, capacity,
            to.facet, to.measure)
      .submit(n, 0, done);
}

}  // namespace powercell
