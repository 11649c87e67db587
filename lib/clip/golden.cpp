#include "lib/clip/golden.hpp"

#include <cmath>

#include "kernels/layout.h"
#include "lib/base/text.hpp"
#include "lib/clip/clipper.hpp"

namespace powercell {

namespace {

/// The weights of the seeds at 1/4 and 3/4 along each axis, summed over the axes in a seed. The wall between
/// the layers of an axis is at 1/2 + (w_0 - w_1).
constexpr double layer_weight[3][2] = {{0.0, 0.125}, {0.0625, 0.0}, {0.0, 0.03125}};

double wall_position(int axis) {
  return 0.5 + layer_weight[axis][0] - layer_weight[axis][1];
}

}  // namespace

RegionMesh golden_mesh(const Variant& variant) {
  RegionMesh mesh;
  mesh.kind = variant.cell_dimension == 3 ? DomainKind::volume
              : variant.dimension == 3    ? DomainKind::surface
                                          : DomainKind::polygon;
  mesh.dimension = variant.dimension;
  mesh.cell_dimension = variant.cell_dimension;
  mesh.shape = variant.cell_dimension == 3 ? RegionShape::box : RegionShape::polygon;
  const int corners = variant.cell_dimension == 3 ? 8 : 4;
  for (int c = 0; c < corners; ++c) {
    const int around = corners == 4 ? c ^ (c >> 1) : c;  // counter-clockwise for the square
    mesh.vertices.push_back(around & 1);
    mesh.vertices.push_back(around >> 1 & 1);
    if (variant.dimension == 3) mesh.vertices.push_back(corners == 4 ? 0.25 : around >> 2);
    mesh.region_vertex.push_back(static_cast<std::uint32_t>(c));
  }
  const std::uint32_t facets = corners == 8 ? 6 : 4;
  for (std::uint32_t f = 0; f < facets; ++f) mesh.facet.push_back({Border::Kind::boundary, f});
  mesh.region_offset = {0, static_cast<std::uint32_t>(corners)};
  mesh.facet_offset = {0, facets};
  mesh.source = {0};
  mesh.boundary_count = facets;
  mesh.measure = 1;
  mesh.high = {1, 1, variant.dimension == 3 ? 1.0 : 0.0};
  return mesh;
}

// One seed for each choice of layers. On a surface those of the upper z-layer are hidden.
SeedSet golden_seeds(int dimension) {
  std::vector<double> positions, weights;
  for (int s = 0; s < 1 << dimension; ++s) {
    double weight = 0;
    for (int k = 0; k < dimension; ++k) {
      positions.push_back((s >> k & 1) != 0 ? 0.75 : 0.25);
      weight += layer_weight[k][s >> k & 1];
    }
    weights.push_back(weight);
  }
  return make_seed_set({dimension, positions, weights}, dimension, 1);
}

// The bits of `s` are the layers of the seed.
double golden_measure(const Variant& variant, std::uint32_t s) {
  double product = 1;
  for (int k = 0; k < variant.cell_dimension; ++k)
    product *= (s >> k & 1) != 0 ? 1 - wall_position(k) : wall_position(k);
  if (variant.dimension == 3 && variant.cell_dimension == 2 && (s >> 2 & 1) != 0)
    return 0;  // wall above z = 1/4
  return product;
}

Domain golden_simplices(const Variant& variant) {
  if (variant.cell_dimension == 2) {
    const double square[] = {0, 0, 0.25, 1, 0, 0.25, 1, 1, 0.25, 0, 1, 0.25};
    const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    return Domain::surface(square, triangles);
  }
  std::vector<double> cube;
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) cube.push_back(c >> k & 1);
  // Around the diagonal from corner 0 to corner 7.
  const std::uint32_t tetrahedra[] = {0, 1, 3, 7, 0, 3, 2, 7, 0, 2, 6, 7, 0, 6, 4, 7, 0, 4, 5, 7, 0, 5, 1, 7};
  return Domain::volume(cube, tetrahedra);
}

namespace {

double golden_density(double x, double y, double z) {
  return 1 + x + 2 * y + 3 * z;
}

}  // namespace

std::vector<double> golden_densities(const Domain& simplices) {
  const std::span<const double> vertices = simplices.regions().vertices;
  std::vector<double> values;
  for (std::size_t v = 0; v < vertices.size(); v += 3)
    values.push_back(golden_density(vertices[v], vertices[v + 1], vertices[v + 2]));
  return values;
}

// Of a box, the mean density is that in its middle.
double golden_mass(const Variant& variant, std::uint32_t s) {
  double middle[3] = {0, 0, 0.25};
  for (int k = 0; k < variant.cell_dimension; ++k) middle[k] = ((s >> k & 1) + wall_position(k)) / 2;
  return golden_measure(variant, s) * golden_density(middle[0], middle[1], middle[2]);
}

void require_golden(const cl::Context& context, std::string_view program, const Variant& variant,
                    std::uint32_t s, double found, double expected) {
  const double tolerance = variant.float32 ? 1e-5 : 1e-13;
  if (std::abs(found - expected) <= tolerance) return;
  std::string options;
  for (const std::string& define : variant.defines()) options += " -D" + define;
  const DeviceInfo& info = context.info();
  throw Error(ErrorCode::self_test_failed,
              "the device " + info.name + " (" + info.platform_name + ", driver " + info.driver_version +
                  ") computed a known diagram wrongly: cell " + std::to_string(s) + " measures " +
                  digits(found) + " instead of " + digits(expected) + ", in " + std::string(program) +
                  options + "; update its driver or choose another device");
}

namespace {

std::vector<double> read_measures(Clipper& clipper, const Scene& scene) {
  const std::size_t stride = 2 + static_cast<std::size_t>(scene.mesh().dimension), n = scene.seeds.size();
  std::vector<double> measures(n);
  std::vector<float> narrow(n * stride);
  std::vector<double> wide(n * stride);
  if (scene.float32())
    clipper.moments().read(narrow.data(), narrow.size() * sizeof(float));
  else
    clipper.moments().read(wide.data(), wide.size() * sizeof(double));
  for (std::size_t i = 0; i < n; ++i)
    measures[i] = (scene.float32() ? static_cast<double>(narrow[i * stride]) : wide[i * stride]) *
                  scene.frame().unit(scene.mesh().cell_dimension);
  return measures;
}

}  // namespace

void golden_test(const std::shared_ptr<cl::Context>& context, const Candidates& candidates,
                 const Variant& variant, std::size_t capacity) {
  const RegionMesh mesh = golden_mesh(variant);
  const SeedSet seeds = golden_seeds(variant.dimension);
  const PackedTree tree = build_packed_tree(seeds, 1);
  const OwnScene own(context, mesh, variant.float32, seeds, tree);
  const std::unique_ptr<Candidates> source = candidates.for_scene(own.scene);
  Clipper clipper(own.scene, *source, OUTPUT_MOMENTS | OUTPUT_WALLS | OUTPUT_GEOMETRY);
  std::vector<std::uint32_t> pair_seed, pair_region(seeds.size(), 0);
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank) pair_seed.push_back(rank);
  clipper.clip_with(capacity, pair_seed, pair_region);
  const std::vector<double> measures = read_measures(clipper, own.scene);
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank)
    require_golden(*context, candidates.file(), variant, seeds.input[rank], measures[rank],
                   golden_measure(variant, seeds.input[rank]));
}

}  // namespace powercell
