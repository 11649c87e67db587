/// \file
/// The repair of a DeviceDiagram: the cells that the device has left undecided.
#pragma once

#include <powercell/diagram.hpp>
#include <powercell/opencl.hpp>
#include <vector>

#include "lib/device_diagram/geometry.hpp"
#include "lib/integrate/nodal_density.hpp"

namespace powercell {

/// How much fits the caller's buffers.
struct Rooms {
  std::uint32_t rows = 0;       ///< entries of DeviceAdjacency
  std::uint32_t uncertain = 0;  ///< seeds of DeviceUncertain
  CellRooms cells = {};
  std::uint32_t boundary = 0;  ///< entries of DeviceBoundaryWalls
};

inline bool wants_rows(const DeviceResults& r) {
  return r.adjacency.offset || r.adjacency.neighbor || r.adjacency.wall || r.adjacency.shift;
}
inline bool wants_list(const DeviceResults& r) {
  return r.uncertain.count || r.uncertain.seeds;
}

inline bool wants_cells(const DeviceResults& r) {
  const DeviceCells& c = r.cells;
  return c.counts || c.cell_offset || c.region || c.vertex_offset || c.vertices || c.face_offset ||
         c.border || c.shift || c.loop_offset || c.loop;
}

inline bool wants_boundary(const DeviceResults& r) {
  const DeviceBoundaryWalls& b = r.boundary_walls;
  return b.offset || b.facet || b.measure;
}

/// Computes cells with a Diagram, which is kept, and so are its programs, its memory and, for seeds at the
/// same positions, their order and tree.
class DeviceRepair {
 public:
  /// \param options  of the DeviceDiagram, with the precision that it has chosen
  DeviceRepair(const Device& device, const Domain& domain, Options options);

  /// As DeviceDiagram::repair, of checked arguments.
  /// \pre n > 0
  /// \param density  that of the diagram, at the vertices of its mesh; null: none
  std::uint32_t run(cl_mem positions, cl_mem weights, std::uint32_t n, const DeviceResults& results,
                    Rooms rooms, cl_mem density);

 private:
  /// \return how many cells were computed
  template <class Real>
  std::uint32_t repair(cl_mem positions, cl_mem weights, std::uint32_t n, const DeviceResults& results,
                       std::vector<std::uint32_t> list, const Rooms& rooms, cl_mem density);
  /// The integrals of the density over the selected cells. Waits.
  template <class Real>
  NodalIntegrals integrals(cl_mem density, const std::vector<std::uint32_t>& list);
  void set_seeds(std::vector<double> positions, const std::vector<double>& weights);

  int threads_;
  Diagram diagram_;
  std::vector<double> positions_;  // of the seeds that the diagram has
};

}  // namespace powercell
