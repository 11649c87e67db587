#include "lib/diagram/setup.hpp"

#include <algorithm>

#include "lib/base/threads.hpp"
#include "lib/cl/errors.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/outline.hpp"

namespace powercell {

Precision choose_precision(const Device& device, Precision asked) {
  const std::vector<Device> members = device.members();
  const auto without =
      std::find_if(members.begin(), members.end(), [](const Device& member) { return !member.info().fp64; });
  if (asked == Precision::automatic)
    return without == members.end() ? Precision::float64 : Precision::float32;
  if (asked == Precision::float64 && without != members.end())
    throw Error(ErrorCode::no_fp64,
                "device \"" + without->info().name + "\"" +
                    (members.size() > 1 ? " (" + without->info().selector() + " of a group)" : "") +
                    " has no double precision; use single precision or another device");
  return asked;
}

namespace {

Neighbors choose_neighbors(Neighbors asked) {
#ifndef POWERCELL_HAS_FLANN
  if (asked == Neighbors::flann)
    throw Error(ErrorCode::unsupported,
                "this build does not include FLANN; use the tree, or build with POWERCELL_FLANN=ON");
#endif
  return asked == Neighbors::automatic ? Neighbors::tree : asked;
}

Options checked(Options options) {
  const auto refuse = [](const char* name, int value) {
    throw Error(ErrorCode::invalid_argument, std::string(name) + " is " + std::to_string(value) +
                                                 "; it must not be negative (0 lets the library choose)");
  };
  if (options.initial_neighbors < 0) refuse("initial_neighbors", options.initial_neighbors);
  if (options.threads < 0) refuse("threads", options.threads);
  return options;
}

RegionMesh make_clip_mesh(const RegionMesh& mesh, bool has_inside) {
  if (has_inside) return with_container(mesh);
  if (!mesh.period) return {};
  const auto d = static_cast<std::size_t>(mesh.dimension);
  return *build_box(std::span(mesh.period->room_low()).first(d),
                    std::span(mesh.period->room_high()).first(d));
}

/// Whether measures and walls come from the boundary of the domain. Where tetrahedra overlap, points inside
/// have no definite side; the other conditions are those of exact decisions on double precision.
bool goes_by_boundary(const DiagramSetup& setup) {
  const RegionMesh& mesh = setup.domain.mesh();
  if (mesh.solid_boundary) {
    if (setup.float32())
      throw Error(
          ErrorCode::unsupported,
          "solids need double precision; use it, or a tetrahedral mesh of the solid (Domain::volume)");
    if (setup.neighbors != Neighbors::tree)
      throw Error(ErrorCode::unsupported,
                  "solids need the tree; use it, or a tetrahedral mesh of the solid (Domain::volume)");
    return true;
  }
  return setup.has_inside && mesh.shape == RegionShape::tetrahedron && mesh.report.overlaps == 0 &&
         !setup.float32() && setup.neighbors == Neighbors::tree &&
         setup.options.decisions == Decisions::exact;
}

}  // namespace

std::shared_ptr<const RegionMesh> clip_mesh_of(const Domain& domain) {
  const RegionMesh& mesh = domain.mesh();
  return mesh.kept.get<RegionMesh>(
      [&] { return std::make_shared<RegionMesh>(make_clip_mesh(mesh, powercell::has_inside(mesh))); });
}

DiagramSetup::DiagramSetup(Device device_in, Domain domain_in, Options options_in)
    : device(std::move(device_in)),
      members(device.members()),
      domain(std::move(domain_in)),
      options(checked(std::move(options_in))),
      progress(std::make_shared<StageProgress>(options.progress)),
      precision(choose_precision(device, options.precision)),
      neighbors(choose_neighbors(options.neighbors)),
      threads(thread_count(options.threads)),
      has_inside(powercell::has_inside(domain.mesh())),
      kept_clip_mesh(clip_mesh_of(domain)),
      clip_mesh(*kept_clip_mesh),
      on_device(device.context(), has_inside || period() ? clip_mesh : domain.mesh(),
                precision == Precision::float32),
      pairs(domain.mesh(), threads) {
  if (goes_by_boundary(*this))
    boundary = std::make_unique<SolidBoundary>(device.context(), domain.mesh(), threads);
  if (options.progress)
    options.progress = [stages = progress](double fraction) { return stages->report(fraction); };
}

void rethrow_of(const DiagramSetup& setup, const Device& device, const Error& error) {
  if (setup.members.size() == 1 || !cl::is_of_device(error.code())) throw error;
  throw Error(error.code(), "device " + device.info().selector() + " \"" + device.info().name +
                                "\" of a group: " + error.what());
}

}  // namespace powercell
