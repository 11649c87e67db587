#include "lib/clip/host_clip.hpp"

#include <string>

namespace powercell {

namespace host_polygon2 {
HostPiece clip(const HostScene&, std::uint32_t, std::uint32_t, std::size_t);
void pack_blocks(HostScene&);
}  // namespace host_polygon2
namespace host_polygon3 {
HostPiece clip(const HostScene&, std::uint32_t, std::uint32_t, std::size_t);
}
namespace host_polyhedron {
HostPiece clip(const HostScene&, std::uint32_t, std::uint32_t, std::size_t);
void pack_blocks(HostScene&);
}  // namespace host_polyhedron

HostScene make_host_scene(const Scene& scene) {
  Frame frame = scene.frame();
  frame.split = false;  // differences of doubles need no shift, and scaling is exact
  frame.centre = {};
  const SeedSet& seeds = scene.seeds();
  const PackedTree& tree = scene.tree();
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
  host.scale = exact_scale(host.points, host.corners);
  mesh.dimension == 3 ? host_polyhedron::pack_blocks(host) : host_polygon2::pack_blocks(host);
  return host;
}

HostPiece clip_on_host(const HostScene& scene, std::uint32_t rank, std::uint32_t region) {
  const auto clip = scene.mesh->cell_dimension == 3 ? host_polyhedron::clip
                    : scene.mesh->dimension == 3    ? host_polygon3::clip
                                                    : host_polygon2::clip;
  std::size_t vertices = 256;
  HostPiece piece = clip(scene, rank, region, vertices);
  while (piece.status == PIECE_FULL) piece = clip(scene, rank, region, vertices *= 4);
  if (piece.status != PIECE_TANGLED) return piece;
  throw Error(ErrorCode::internal, "the cell of the seed at position " + std::to_string(rank) +
                                       " of the Hilbert order could not be clipped without contradiction "
                                       "even on the host; please report the input");
}

}  // namespace powercell
