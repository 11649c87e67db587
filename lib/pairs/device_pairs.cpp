#include "lib/pairs/device_pairs.hpp"

#include "lib/regions/region_groups.hpp"

namespace powercell {
namespace {

void upload(cl::RawBuffer& buffer, const std::vector<std::byte>& bytes) {
  buffer.reserve(bytes.size());
  if (!bytes.empty()) buffer.write(bytes.data(), bytes.size());
}

}  // namespace

DevicePairs::RegionTree::RegionTree(const DomainBuffers& domain, const std::vector<std::string>& defines)
    : count(static_cast<std::uint32_t>(domain.mesh().region_count())),
      region(domain.context()),
      low(domain.context()),
      high(domain.context()),
      nodes(domain.context(), defines),
      owner(domain.context()),
      node_owner(domain.context()),
      find_owners(domain.context(), domain.context()->program("pairs/region_pairs.cl", defines),
                  "find_owners"),
      find_pairs(domain.context(), domain.context()->program("pairs/region_pairs.cl", defines),
                 "find_pairs") {
  const RegionGroups groups(domain.mesh(), 1);
  region.upload(groups.order);
  upload(low, domain.frame().pack(domain.mesh().dimension, groups.level[0].low, {}));
  upload(high, domain.frame().pack(domain.mesh().dimension, groups.level[0].high, {}));
  nodes.enqueue(low.handle(), high.handle(), count);
  owner.resize(count);
  node_owner.resize(nodes.node_count());
}

DevicePairs::DevicePairs(const DomainBuffers& domain, const std::vector<std::string>& defines)
    : seed(domain.context()),
      region(domain.context()),
      offset(domain.context()),
      domain_(domain),
      scan_(domain.context(), ExclusiveScan::Type::uint64) {
  if (domain.mesh().region_count() == 1)
    pair_all_.emplace(domain.context(), domain.context()->program("pairs/one_region.cl", {}), "pair_all");
  else
    regions_.emplace(domain, defines);
}

void DevicePairs::reserve(std::uint32_t pairs) {
  seed.resize(pairs);
  region.resize(pairs);
  capacity = pairs;
}

void DevicePairs::find_owners(const DeviceSeeds& seeds, const DeviceTree& tree, std::uint32_t n) {
  RegionTree& r = *regions_;
  const auto find = [&](const cl::RawBuffer& low, const cl::RawBuffer& high,
                        cl::Buffer<std::uint32_t>& owner) {
    const auto count = static_cast<cl_uint>(owner.size());
    r.find_owners
        .args(count, low, high, owner, seeds.points, n, tree.node_low, tree.node_high, tree.level_offset,
              cl_int{tree.levels()})
        .submit(count);
  };
  find(r.low, r.high, r.owner);
  find(r.nodes.node_low, r.nodes.node_high, r.node_owner);
}

void DevicePairs::find(const DeviceSeeds& seeds, const DeviceTree& tree, std::uint32_t n, bool write) {
  RegionTree& r = *regions_;
  r.find_pairs
      .args(n, cl_int{write}, seeds.state, seeds.points, tree.node_low, tree.node_high, tree.level_offset,
            cl_int{tree.levels()}, r.count, r.region, r.low, r.high, r.nodes.node_low, r.nodes.node_high,
            r.nodes.level_offset, cl_int{r.nodes.levels()}, r.owner, r.node_owner, domain_.corners,
            domain_.region_offset, domain_.region_vertex, cl_ulong{capacity}, offset, seed, region)
      .submit(std::size_t{n} + 1);
}

std::uint32_t DevicePairs::read_number(std::uint32_t n) const {
  std::uint64_t number = 0;
  offset.download(std::span(&number, 1), n);
  if (number > most_pairs)
    throw Error(
        ErrorCode::out_of_device_memory,
        "the seeds and regions make " + std::to_string(number) +
            " pairs, more than a diagram in device memory can hold; use Diagram, which works in chunks");
  return static_cast<std::uint32_t>(number);
}

void DevicePairs::enqueue(const DeviceSeeds& seeds, const DeviceTree& tree, std::uint32_t n,
                          std::uint32_t most) {
  offset.resize(std::size_t{n} + 1);
  if (pair_all_) {
    reserve(n);
    pair_all_->args(n, seed, region, offset).submit(std::size_t{n} + 1);
    return;
  }
  reserve(most);
  find_owners(seeds, tree, n);
  find(seeds, tree, n, false);
  scan_.enqueue(offset.handle(), n + 1);
  if (most == 0) reserve(read_number(n));
  find(seeds, tree, n, true);
}

}  // namespace powercell
