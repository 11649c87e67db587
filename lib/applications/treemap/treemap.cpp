#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <powercell/treemap.hpp>
#include <string>

#include "lib/applications/treemap/convex_polygon.hpp"
#include "lib/applications/treemap/group.hpp"
#include "lib/applications/treemap/hierarchy.hpp"
#include "lib/base/float_environment.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

using namespace treemap_detail;

/// Lays out a tree level by level, as the groups of a level are independent of each other.
class Layout {
 public:
  Layout(const Hierarchy& tree, const TreemapOptions& options, Treemap& result)
      : tree_(tree),
        options_(options),
        result_(result),
        threads_(thread_count(options.threads)),
        polygon_(tree.size()),
        device_(options.device) {
    // The relative errors of the levels add up.
    const auto levels = static_cast<double>(std::max<std::size_t>(tree.level.size(), 3) - 2);
    settings_ = {options.rounds, options.tolerance / levels};
    for (int t = 0; t < threads_; ++t) solvers_.emplace_back();
  }

  void run(std::vector<double> outline) {
    polygon_[tree_.root] = std::move(outline);
    result_.seeds.assign(2 * tree_.size(), std::numeric_limits<double>::quiet_NaN());
    set_seed(tree_.root, GroupFrame(moments(polygon_[tree_.root])), 0, 0);
    for (std::size_t level = 0; level + 1 < tree_.level.size(); ++level) lay_out_level(level);
    std::sort(result_.not_converged.begin(), result_.not_converged.end());
    collect();
  }

 private:
  void lay_out_level(std::size_t level) {
    std::vector<std::uint32_t> groups, large;
    for (std::size_t k = tree_.level[level]; k < tree_.level[level + 1]; ++k) {
      const std::uint32_t node = tree_.order[k];
      const std::size_t children = tree_.children(node).size();
      if (children > 0 && !(moments(polygon_[node]).area > 0)) {
        leave_without_place(node);
        continue;
      }
      if (children == 1) hand_down(node);
      if (children > 1) (children > options_.large_group ? large : groups).push_back(node);
    }
    for (const std::uint32_t node : large) {
      if (!device_) device_ = Device::choose();
      const Group group = make_group(node);
      const auto children = static_cast<double>(tree_.children(node).size());
      take(node, lay_out_large(group, settings_, *device_, threads_,
                               [&](double fraction) { return go_on(fraction * children); }));
    }
    // The largest groups first, so that the threads finish at about the same time.
    std::stable_sort(groups.begin(), groups.end(), [this](std::uint32_t a, std::uint32_t b) {
      return tree_.children(a).size() > tree_.children(b).size();
    });
    parallel_tasks(threads_, groups.size(), [&](int worker, std::size_t task) {
      const Group group = make_group(groups[task]);
      take(groups[task], solvers_[static_cast<std::size_t>(worker)].lay_out(group, settings_));
    });
  }

  /// Leaves the children of a node without polygons: it is thinner than the rounding of its corners.
  void leave_without_place(std::uint32_t node) {
    result_.not_converged.push_back(node);
    done(tree_.children(node).size());
  }

  void hand_down(std::uint32_t node) {
    const std::uint32_t child = tree_.children(node)[0];
    polygon_[child] = polygon_[node];
    set_seed(child, GroupFrame(moments(polygon_[node])), 0, 0);
    done(1);
  }

  void set_seed(std::size_t node, const GroupFrame& frame, double x, double y) {
    result_.seeds[2 * node] = frame.outside_x(x);
    result_.seeds[2 * node + 1] = frame.outside_y(y);
  }

  Group make_group(std::uint32_t node) const {
    const GroupFrame frame(moments(polygon_[node]));
    Group group;
    group.outline = frame.inside(polygon_[node]);
    bool started = false;
    for (const std::uint32_t c : tree_.children(node)) {
      group.share.push_back(tree_.value[c] / tree_.value[node]);
      started |= !options_.start.empty() && std::isfinite(options_.start[2 * c]);
    }
    if (started)
      for (const std::uint32_t c : tree_.children(node)) {
        group.start.x.push_back(options_.start[2 * c]);
        group.start.y.push_back(options_.start[2 * c + 1]);
      }
    group.random_seed = options_.random_seed * 0x9e3779b97f4a7c15u + node;
    return group;
  }

  void take(std::uint32_t node, const GroupLayout& layout) {
    const GroupFrame frame(moments(polygon_[node]));
    const auto children = tree_.children(node);
    bool complete = true;  // a tolerance of 1 or more allows empty cells, which have no polygon
    for (std::size_t i = 0; i < children.size(); ++i) {
      set_seed(children[i], frame, layout.seeds.x[i], layout.seeds.y[i]);
      std::vector<double>& polygon = polygon_[children[i]];
      polygon.reserve(2 * (layout.offset[i + 1] - layout.offset[i]));
      for (std::uint64_t v = layout.offset[i]; v < layout.offset[i + 1]; ++v) {
        polygon.push_back(frame.outside_x(layout.vertices[2 * v]));
        polygon.push_back(frame.outside_y(layout.vertices[2 * v + 1]));
      }
      complete &= !polygon.empty();
    }
    const std::scoped_lock lock(mutex_);
    result_.diagrams += layout.diagrams;
    result_.newton_steps += layout.newton_steps;
    if (!layout.converged || !complete) result_.not_converged.push_back(node);
    done(children.size());
  }

  void done(std::size_t nodes) {
    done_ += nodes;
    if (!go_on()) throw Error(ErrorCode::interrupted, "treemap: interrupted");
  }

  /// \param more  nodes done beside `done_`
  bool go_on(double more = 0) const {
    return !options_.progress ||
           options_.progress((static_cast<double>(done_) + more) / static_cast<double>(tree_.order.size()));
  }

  void collect() {
    result_.vertex_offset.assign(1, 0);
    for (const std::vector<double>& polygon : polygon_) {
      result_.vertices.insert(result_.vertices.end(), polygon.begin(), polygon.end());
      result_.vertex_offset.push_back(result_.vertices.size() / 2);
    }
  }

  const Hierarchy& tree_;
  const TreemapOptions& options_;
  Treemap& result_;
  int threads_;
  std::vector<std::vector<double>> polygon_;
  std::optional<Device> device_;
  GroupSettings settings_;
  std::vector<GroupSolver> solvers_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

void measure_leaves(Treemap& map, std::size_t root) {
  const auto polygon = [&](std::size_t i) {
    return std::span<const double>(map.vertices)
        .subspan(2 * map.vertex_offset[i], 2 * (map.vertex_offset[i + 1] - map.vertex_offset[i]));
  };
  const double whole = moments(polygon(root)).area;
  double aspects = 0;
  std::size_t with_area = 0;
  for (std::size_t i = 0; i < map.kind.size(); ++i) {
    if (map.kind[i] != TreeNode::leaf) continue;
    const PolygonMoments m = moments(polygon(i));
    const double error = std::fabs(m.area / whole / (map.value[i] / map.value[root]) - 1);
    if (!(error <= map.worst_error)) {
      map.worst_error = error;
      map.worst_leaf = i;
    }
    ++map.leaves;
    if (!(m.area > 0)) continue;
    aspects += aspect(m);
    ++with_area;
  }
  map.mean_aspect = aspects / static_cast<double>(with_area);  // not 0, as the outline has an area
}

}  // namespace

Treemap treemap(const TreeView& tree, const Ring& outline, const TreemapOptions& options) {
  const FloatEnvironment environment;
  if (!options.start.empty() && options.start.size() != 2 * tree.parent.size())
    throw Error(ErrorCode::invalid_argument, "treemap: the start must have two numbers for each node");
  if (!(options.tolerance > 0) || options.rounds < 0)
    throw Error(ErrorCode::invalid_argument,
                "treemap: the tolerance must be above 0 and the rounds at least 0");
  Hierarchy hierarchy = make_hierarchy(tree, options.name);
  Treemap result;
  Layout(hierarchy, options, result).run(convex_outline(outline));
  result.kind = std::move(hierarchy.kind);
  result.value = std::move(hierarchy.value);
  result.depth = std::move(hierarchy.depth);
  measure_leaves(result, hierarchy.root);
  return result;
}

std::vector<double> relative_positions(std::span<const std::int64_t> parent, std::span<const double> seeds,
                                       std::span<const std::uint64_t> vertex_offset,
                                       std::span<const double> vertices) {
  const FloatEnvironment environment;
  const std::size_t n = parent.size();
  if (seeds.size() != 2 * n || vertex_offset.size() != n + 1 || vertices.size() % 2 != 0 ||
      vertices.size() / 2 != vertex_offset[n])
    throw Error(ErrorCode::invalid_argument, "relative_positions: the sizes do not match");
  if (!std::is_sorted(vertex_offset.begin(), vertex_offset.end()))
    throw Error(ErrorCode::invalid_argument, "relative_positions: vertex_offset does not ascend");
  std::vector<PolygonMoments> of(n);
  for (std::size_t i = 0; i < n; ++i)
    of[i] = moments(vertices.subspan(2 * vertex_offset[i], 2 * (vertex_offset[i + 1] - vertex_offset[i])));
  std::vector<double> position(2 * n, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < n; ++i) {
    if (parent[i] < 0 || parent[i] >= static_cast<std::int64_t>(n) || !(of[i].area > 0)) continue;
    const PolygonMoments& above = of[static_cast<std::size_t>(parent[i])];
    if (!(above.area > 0)) continue;
    const GroupFrame frame(above);
    const bool known = std::isfinite(seeds[2 * i]) && std::isfinite(seeds[2 * i + 1]);
    position[2 * i] = ((known ? seeds[2 * i] : of[i].x) - frame.x) / frame.size;
    position[2 * i + 1] = ((known ? seeds[2 * i + 1] : of[i].y) - frame.y) / frame.size;
  }
  return position;
}

}  // namespace powercell
