/// \file
/// The constant part of a Diagram, and its progress.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <powercell/error.hpp>
#include <powercell/options.hpp>
#include <utility>
#include <vector>

#include "lib/pairs/pair_finder.hpp"
#include "lib/scene/domain_buffers.hpp"
#include "lib/solid/solid_cells.hpp"

namespace powercell {

/// Options::progress of a computation of several passes, each of several parts. The fraction never falls,
/// also where a pass is repeated.
class StageProgress {
 public:
  explicit StageProgress(std::function<bool(double)> callback) : callback_(std::move(callback)) {}

  void begin_computation() { reached_ = 0; }
  /// \param from, to  fractions of the computation
  void begin_pass(double from, double to) {
    pass_from_ = from;
    pass_to_ = to;
    begin_part(0, 1);
  }
  /// \param from, to  fractions of the pass
  void begin_part(double from, double to) {
    from_ = pass_from_ + from * (pass_to_ - pass_from_);
    to_ = pass_from_ + to * (pass_to_ - pass_from_);
  }
  /// \param fraction  of the part
  /// \return false if the caller asks to stop
  bool report(double fraction) {
    reached_ = std::max(reached_, from_ + fraction * (to_ - from_));
    return callback_(reached_);
  }

 private:
  std::function<bool(double)> callback_;
  double pass_from_ = 0, pass_to_ = 1;
  double from_ = 0, to_ = 1;
  double reached_ = 0;
};

/// Resolves Precision::automatic for a device; of a group double only if all have it.
/// \throw Error no_fp64
Precision choose_precision(const Device& device, Precision asked);

/// The mesh that cells are clipped by where it is not the domain's, kept with the domain: with a container
/// for cells inside it; of a periodic domain, the room around all cells of wrapped seeds. Else it is empty.
std::shared_ptr<const RegionMesh> clip_mesh_of(const Domain& domain);

struct DiagramSetup {
  Device device;                ///< or a group; its first member does all that is not shared
  std::vector<Device> members;  ///< of the group
  Domain domain;
  Options options;  ///< its `progress` reports through the one below
  std::shared_ptr<StageProgress> progress;
  Precision precision;  ///< not automatic
  Neighbors neighbors;  ///< not automatic
  int threads;
  bool has_inside;  ///< whether a cell inside the domain can meet several of its regions
  std::shared_ptr<const RegionMesh> kept_clip_mesh;  ///< clip_mesh_of() the domain
  const RegionMesh& clip_mesh;
  DomainBuffers on_device;  ///< of `clip_mesh`, or of the domain
  PairFinder pairs;
  /// Null unless cells at the boundary are computed from it alone.
  std::unique_ptr<SolidBoundary> boundary;

  /// \throw Error no_fp64; invalid_argument, unsupported (options); opencl, out_of_device_memory
  DiagramSetup(Device device, Domain domain, Options options);
  const Period* period() const { return domain.mesh().period.get(); }  ///< null if not periodic
  bool float32() const { return on_device.float32(); }
  /// Whether cells are decided exactly; those computed from the boundary alone always are.
  bool exact() const { return options.decisions == Decisions::exact || boundary; }
};

/// Throws `error` again, with the name of the device before its message if it comes from the device and this
/// is one of several.
[[noreturn]] void rethrow_of(const DiagramSetup& setup, const Device& device, const Error& error);

/// Calls `body`, which uses a device of the setup. Of a group, errors of the device name it.
template <class Body>
decltype(auto) on_device(const DiagramSetup& setup, const Device& device, const Body& body) {
  try {
    return body();
  } catch (const Error& error) {
    rethrow_of(setup, device, error);
  }
}

}  // namespace powercell
