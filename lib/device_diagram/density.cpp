#include "lib/device_diagram/density.hpp"

#include "kernels/layout.h"

namespace powercell {
namespace {

std::size_t real_bytes_of(const DomainBuffers& domain) {
  return domain.float32() ? sizeof(float) : sizeof(double);
}

}  // namespace

DeviceDensity::DeviceDensity(const DomainBuffers& domain, const std::vector<std::string>& defines)
    : domain_(domain),
      affine_(domain.context(), domain.context()->program("device_diagram/density.cl", defines),
              "affine_density"),
      write_(domain.context(), domain.context()->program("device_diagram/finish.cl", defines),
             "write_density"),
      of_regions_(domain.context()),
      moments_(domain.context()) {}

void DeviceDensity::set(cl_mem values) {
  if (values) cl::check(cl::clRetainMemObject(values), "retaining the caller's buffer of the density");
  if (values_) cl::clReleaseMemObject(values_);
  values_ = values;
}

void DeviceDensity::begin(std::uint32_t pairs) {
  const std::size_t regions = domain_.mesh().region_count(), real = real_bytes_of(domain_);
  of_regions_.reserve(regions * DENSITY_SIZE * real);
  moments_.reserve(std::size_t{pairs} * (2 + static_cast<std::size_t>(domain_.mesh().dimension)) * real);
  affine_
      .args(static_cast<cl_uint>(regions), domain_.corners, domain_.region_offset, domain_.region_vertex,
            values_, of_regions_)
      .submit(regions);
}

void DeviceDensity::append_arguments(cl::Kernel& kernel) const {
  kernel.more_args(of_regions_, moments_);
}

void DeviceDensity::write(const DeviceSeeds& seeds, const DevicePairs& pairs, cl_mem status, cl_mem frame,
                          cl_mem positions, std::uint32_t n, cl_mem measures, cl_event* done) {
  write_.args(n, seeds.order, status, pairs.offset, moments_, frame, positions, measures).submit(n, 0, done);
}

}  // namespace powercell
