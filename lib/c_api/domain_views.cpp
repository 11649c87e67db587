// What a domain is, as structs of C that last as long as its handle.
#include <powercell/regions.hpp>

#include "lib/c_api/handles.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

static_assert(static_cast<int>(DomainKind::volume) == PC_VOLUME);
static_assert(static_cast<int>(RegionShape::box) == PC_REGION_BOX);

pc_domain_info info_of(const Domain& from) {
  pc_domain_info to{};
  to.kind = static_cast<pc_domain_kind>(from.kind());
  to.dimension = from.dimension();
  to.cell_dimension = from.cell_dimension();
  to.is_periodic = from.is_periodic();
  to.is_solid = from.is_solid();
  to.measure = from.measure();
  const auto low = from.low(), high = from.high();
  const auto periods = from.periods();
  for (std::size_t k = 0; k < 3; ++k) {
    to.low[k] = low[k];
    to.high[k] = high[k];
    std::copy(periods[k].begin(), periods[k].end(), to.periods[k]);
  }
  to.region_count = from.region_count();
  return to;
}

pc_mesh_report report_of(const MeshReport& from, const std::vector<const char*>& notes) {
  pc_mesh_report to{};
  to.flat_count = from.flat.size();
  to.flat = pointer(from.flat);
  to.repeated_count = from.repeated.size();
  to.repeated = from.repeated.empty() ? nullptr : from.repeated.front().data();
  to.overlaps = from.overlaps;
  to.overlap = from.overlap;
  to.largest.first = from.largest.first;
  to.largest.second = from.largest.second;
  to.largest.measure = from.largest.measure;
  std::copy(from.largest.at.begin(), from.largest.at.end(), to.largest.at);
  to.note_count = notes.size();
  to.notes = pointer(notes);
  return to;
}

pc_regions regions_of(const RegionsView& from) {
  pc_regions to{};
  to.shape = static_cast<pc_region_shape>(from.shape);
  to.dimension = from.dimension;
  to.cell_dimension = from.cell_dimension;
  to.count = from.size();
  to.vertex_count =
      from.vertices.empty() ? 0 : from.vertices.size() / static_cast<std::size_t>(from.dimension);
  to.vertices = from.vertices.data();
  to.region_offset = from.region_offset.data();
  to.region_vertex = from.region_vertex.data();
  to.facet_offset = from.facet_offset.data();
  to.facet = reinterpret_cast<const pc_border*>(from.facet.data());
  to.source = from.source.data();
  to.boundary_count = from.boundary_count;
  return to;
}

std::vector<const char*> texts(const std::vector<std::string>& of) {
  std::vector<const char*> all;
  for (const std::string& text : of) all.push_back(text.c_str());
  return all;
}

}  // namespace
}  // namespace powercell::c_api

pc_domain::pc_domain(powercell::Domain made)
    : domain(std::move(made)),
      notes(domain.notes()),
      note_pointers(powercell::c_api::texts(notes)),
      info(powercell::c_api::info_of(domain)),
      report(powercell::c_api::report_of(domain.report(), note_pointers)),
      regions(powercell::c_api::regions_of(domain.regions())) {}
