/// \file
/// The density of a DeviceDiagram, from values at vertices to the measures of cells.
#pragma once

#include <powercell/opencl.hpp>
#include <vector>

#include "lib/pairs/device_pairs.hpp"

namespace powercell {

/// The caller's values, retained, what they make of each region, and the moments of pieces with them.
/// Enqueues without waiting. Memory grows as needed and is reused.
class DeviceDensity {
 public:
  /// Builds the kernels but those that clip.
  /// \param domain   of triangles or tetrahedra; must outlive this
  /// \param defines  of kernels that hold no cell
  DeviceDensity(const DomainBuffers& domain, const std::vector<std::string>& defines);
  DeviceDensity(const DeviceDensity&) = delete;
  DeviceDensity& operator=(const DeviceDensity&) = delete;
  ~DeviceDensity() { set(nullptr); }

  /// \param values  checked, of the context of the domain; null: none.
  /// \throw Error opencl
  void set(cl_mem values);
  cl_mem values() const { return values_; }  ///< null: the density is 1

  /// Reads the values, and makes room for moments of pieces.
  /// \pre there are values
  void begin(std::uint32_t pairs);
  /// Those of the clip kernel (kernels/device_diagram/clip_density.cl).
  void append_arguments(cl::Kernel& kernel) const;
  /// Puts the integrals in place of the measures of cells.
  /// \param status  final, of each seed in input order
  void write(const DeviceSeeds& seeds, const DevicePairs& pairs, cl_mem status, cl_mem frame,
             cl_mem positions, std::uint32_t n, cl_mem measures, cl_event* done);

 private:
  const DomainBuffers& domain_;
  cl_mem values_ = nullptr;
  cl::Kernel affine_, write_;
  cl::RawBuffer of_regions_, moments_;
};

}  // namespace powercell
