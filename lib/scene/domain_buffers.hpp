/// \file
/// The domain in device memory.
#pragma once

#include <memory>

#include "kernels/layout.h"
#include "lib/cl/buffer.hpp"
#include "lib/domain/frame.hpp"

namespace powercell {

/// The vertices and faces of a volume region before it is clipped.
region_shape_t region_shape(RegionShape shape);

/// Per facet of `mesh`: BEHIND_NOTHING, or a number for the region behind it (kernels/layout.h).
std::vector<std::int32_t> regions_behind(const RegionMesh& mesh);

/// The regions of a domain, in the units of its frame. Immutable.
class DomainBuffers {
 public:
  /// Keeps a reference to the mesh.
  /// \throw Error opencl, out_of_device_memory
  DomainBuffers(const std::shared_ptr<cl::Context>& context, const RegionMesh& mesh, bool float32);

  const std::shared_ptr<cl::Context>& context() const { return context_; }
  const RegionMesh& mesh() const { return mesh_; }
  const Frame& frame() const { return frame_; }
  bool float32() const { return frame_.split; }

  cl::RawBuffer corners;  ///< seed_t
  cl::Buffer<std::uint32_t> region_offset, region_vertex;
  cl::Buffer<std::int32_t> behind;  ///< per facet: BEHIND_NOTHING or a corner (kernels/layout.h)
  cl::Buffer<region_shape_t> shape;

 private:
  std::shared_ptr<cl::Context> context_;
  const RegionMesh& mesh_;
  Frame frame_;
};

}  // namespace powercell
