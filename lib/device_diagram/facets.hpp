/// \file
/// What lies behind the facets of regions, in device memory.
#pragma once

#include <vector>

#include "lib/scene/domain_buffers.hpp"

namespace powercell {

struct DeviceFacets {
  /// Uploads them.
  /// \throw Error opencl, out_of_device_memory
  explicit DeviceFacets(const DomainBuffers& domain) : offset(domain.context()), facet(domain.context()) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(2 * domain.mesh().facet.size());
    for (const Border& border : domain.mesh().facet) {
      numbers.push_back(static_cast<std::uint32_t>(border.kind));
      numbers.push_back(border.index);
    }
    facet.upload(numbers);
    offset.upload(domain.mesh().facet_offset);
  }

  cl::Buffer<std::uint32_t> offset;  ///< regions + 1: the first facet of each region
  cl::Buffer<std::uint32_t> facet;   ///< kind and index of each (Border)
};

}  // namespace powercell
