#include "lib/seeds/device_tree.hpp"

#include <numeric>
#include <vector>

#include "lib/domain/frame.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell {
namespace {

/// Number of nodes of each level, from the leaves to the root.
std::vector<std::uint32_t> level_sizes(std::uint32_t seeds) {
  std::vector<std::uint32_t> sizes;
  std::uint32_t count = seeds;
  do {
    count = count / PackedTree::fan + (count % PackedTree::fan != 0 ? 1 : 0);
    sizes.push_back(count);
  } while (count > 1);
  return sizes;
}

}  // namespace

DeviceTree::DeviceTree(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines)
    : node_low(context),
      node_high(context),
      level_offset(context),
      lay_out_(context, context->program("seeds/build_tree.cl", defines), "lay_out_levels"),
      build_(context, context->program("seeds/build_tree.cl", defines), "build_level") {}

void DeviceTree::enqueue(cl_mem low, cl_mem high, std::uint32_t count) {
  const std::vector<std::uint32_t> sizes = level_sizes(count);
  node_count_ = std::accumulate(sizes.begin(), sizes.end(), std::uint32_t{0});
  node_low.reserve(node_count_ * Frame::point_bytes);
  node_high.reserve(node_count_ * Frame::point_bytes);
  level_offset.resize(sizes.size() + 1);
  levels_ = static_cast<int>(sizes.size());

  // Written by a kernel: a copy from host memory would have to wait for the queue or outlive this call.
  lay_out_.args(count, level_offset).submit(1);
  std::uint32_t from = 0, to = 0, children = count;
  for (std::size_t level = 0; level < sizes.size(); ++level) {
    const cl_mem child_low = level == 0 ? low : node_low.handle();
    const cl_mem child_high = level == 0 ? high : node_high.handle();
    build_.args(sizes[level], to, children, from, child_low, child_high, node_low, node_high)
        .submit(sizes[level]);
    children = sizes[level];
    from = to;
    to += sizes[level];
  }
}

}  // namespace powercell
