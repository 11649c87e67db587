#include "lib/clip/host_clip.hpp"

#include "kernels/layout.h"
#include "lib/base/threads.hpp"

namespace powercell {

namespace host_polygon2 {
std::unique_ptr<HostClipper> make_clipper(const HostScene&, bool);
void pack_blocks(HostScene&);
void list_near_leaf(HostScene&, std::uint32_t);
}  // namespace host_polygon2
namespace host_polygon3 {
std::unique_ptr<HostClipper> make_clipper(const HostScene&, bool);
}
namespace host_polyhedron {
std::unique_ptr<HostClipper> make_clipper(const HostScene&, bool);
void pack_blocks(HostScene&);
void list_near_leaf(HostScene&, std::uint32_t);
}  // namespace host_polyhedron

HostScene make_host_scene(const Scene& scene) {
  Frame frame = scene.frame();
  frame.split = false;  // differences of doubles need no shift, and scaling is exact
  frame.centre = {};
  const SeedSet& seeds = scene.seeds;
  const PackedTree& tree = scene.tree;
  const RegionMesh& mesh = scene.mesh();
  HostScene host{frame.pack(mesh.dimension, mesh.vertices, {}),
                 frame.pack(seeds.dimension, seeds.positions, seeds.weights),
                 frame.pack(tree.dimension, tree.low, tree.weight),
                 frame.pack(tree.dimension, tree.high, {}),
                 regions_behind(mesh),
                 region_shape(mesh.shape),
                 &mesh,
                 &tree,
                 {},
                 {},
                 {},
                 {},
                 {}};
  mesh.dimension == 3 ? host_polyhedron::pack_blocks(host) : host_polygon2::pack_blocks(host);
  return host;
}

void list_near(HostScene& scene, std::span<const std::uint32_t> ranks, int threads) {
  const std::size_t leaves = scene.near_count.size();
  if (!scene.near) scene.near = std::make_unique_for_overwrite<std::uint32_t[]>(leaves * NEAR_MOST);
  std::vector<std::uint32_t> homes;
  for (const std::uint32_t rank : ranks) {
    const std::uint32_t home = rank / PackedTree::fan;
    if (scene.near_count[home] == 0 && (homes.empty() || homes.back() != home)) homes.push_back(home);
  }
  const auto list =
      scene.mesh->dimension == 3 ? host_polyhedron::list_near_leaf : host_polygon2::list_near_leaf;
  parallel_for(threads, homes.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) list(scene, homes[k]);
  });
}

std::unique_ptr<HostClipper> HostClipper::make(const HostScene& scene, bool geometry) {
  return scene.mesh->cell_dimension == 3 ? host_polyhedron::make_clipper(scene, geometry)
         : scene.mesh->dimension == 3    ? host_polygon3::make_clipper(scene, geometry)
                                         : host_polygon2::make_clipper(scene, geometry);
}

}  // namespace powercell
