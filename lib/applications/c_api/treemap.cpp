#include <powercell/c/treemap.h>

#include <powercell/treemap.hpp>

#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

static_assert(TreeView::no_parent == PC_NO_PARENT);
static_assert(static_cast<int>(TreeNode::dropped) == PC_NODE_DROPPED && sizeof(TreeNode) == 1);

void fill(pc_treemap& to, const Treemap& from) {
  to.count = from.kind.size();
  to.kind = reinterpret_cast<const std::uint8_t*>(pointer(from.kind));
  to.value = pointer(from.value);
  to.depth = pointer(from.depth);
  to.vertex_offset = pointer(from.vertex_offset);
  to.vertices = pointer(from.vertices);
  to.seeds = pointer(from.seeds);
  to.worst_error = from.worst_error;
  to.worst_leaf = from.worst_leaf;
  to.mean_aspect = from.mean_aspect;
  to.leaves = from.leaves;
  to.not_converged_count = from.not_converged.size();
  to.not_converged = pointer(from.not_converged);
  to.diagrams = from.diagrams;
  to.newton_steps = from.newton_steps;
}

pc_treemap_options defaults() {
  const TreemapOptions from;
  pc_treemap_options to{};
  to.tolerance = from.tolerance;
  to.rounds = from.rounds;
  to.random_seed = from.random_seed;
  to.large_group = from.large_group;
  return to;
}

/// \param count  nodes of the tree
TreemapOptions treemap_options(const pc_treemap_options* options, std::size_t count) {
  const pc_treemap_options from = current(options, defaults(), "pc_treemap_options");
  TreemapOptions to;
  to.tolerance = from.tolerance;
  to.rounds = from.rounds;
  to.threads = from.threads;
  to.random_seed = from.random_seed;
  if (from.start) to.start = rows_view(from.start, count, 2, "options.start");
  if (from.names) {
    for (std::size_t node = 0; node < count; ++node) checked(from.names[node], "a name of options.names");
    to.name = [names = from.names](std::size_t node) { return std::string(names[node]); };
  }
  if (from.device) to.device = from.device->device;
  to.large_group = from.large_group;
  to.progress = progress_of(from.progress, from.progress_user);
  return to;
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_treemap_options_init(pc_treemap_options* options, size_t struct_size) {
  return init(options, struct_size, defaults(), "pc_treemap_options");
}

pc_status pc_treemap_create(const int64_t* parent, const double* value, size_t count, const double* outline,
                            size_t outline_count, const pc_treemap_options* options,
                            const pc_treemap** treemap) {
  return guarded([&] {
    result_at(treemap);
    const TreeView tree{rows_view(parent, count, 1, "parent"), rows_view(value, count, 1, "value")};
    const std::span<const double> points = rows_view(outline, outline_count, 2, "outline");
    Ring ring;
    for (std::size_t k = 0; k < outline_count; ++k) ring.push_back({points[2 * k], points[2 * k + 1]});
    hand_over_result(treemap, powercell::treemap(tree, ring, treemap_options(options, count)), fill);
  });
}

void pc_treemap_destroy(const pc_treemap* treemap) {
  destroy_result<Treemap>(treemap);
}

pc_status pc_treemap_relative_positions(const int64_t* parent, const double* seeds, size_t count,
                                        const uint64_t* vertex_offset, const double* vertices,
                                        double* positions) {
  return guarded([&] {
    if (count != 0) result_at(positions);
    const std::span<const std::int64_t> parents = rows_view(parent, count, 1, "parent");
    const std::span<const double> centres = rows_view(seeds, count, 2, "seeds");
    const std::span<const std::uint64_t> offsets = rows_view(vertex_offset, count + 1, 1, "vertex_offset");
    const std::span<const double> corners = rows_view(vertices, offsets[count], 2, "vertices");
    copy_out(relative_positions(parents, centres, offsets, corners), positions);
  });
}

}  // extern "C"
