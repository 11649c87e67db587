// repair(): its steps, its tolerances and its report.
#include <algorithm>
#include <cmath>
#include <powercell/error.hpp>
#include <powercell/repair.hpp>

#include "lib/applications/remeshing/mesh_check.hpp"
#include "lib/applications/remeshing/repair_steps.hpp"
#include "lib/base/disjoint_sets.hpp"
#include "lib/base/float_environment.hpp"
#include "lib/base/positions.hpp"
#include "lib/base/text.hpp"

namespace powercell {

remeshing::Patchwork remeshing::patchwork_of(std::span<const double> vertices,
                                             std::span<const std::uint32_t> triangles) {
  Patchwork mesh;
  for (std::size_t k = 0; k < vertices.size(); k += 3)
    mesh.vertex.push_back({vertices[k], vertices[k + 1], vertices[k + 2]});
  for (std::size_t k = 0; k < triangles.size(); k += 3)
    mesh.row.push_back({triangles[k], triangles[k + 1], triangles[k + 2]});
  return mesh;
}

namespace {

using namespace remeshing;

/// Sizes that tolerances follow from.
struct Extent {
  double diagonal = 0;
  double rounding = 0;  ///< of coordinates, as far as it shows
};

/// Whether all coordinates are multiples of a step, up to the rounding of double.
bool has_step(const Patchwork& mesh, double step) {
  return std::all_of(mesh.row.begin(), mesh.row.end(), [&](const std::array<std::uint32_t, 3>& row) {
    return std::all_of(row.begin(), row.end(), [&](std::uint32_t v) {
      const Vec x = mesh.vertex[v];
      return std::all_of(&x.x, &x.x + 3, [&](double c) {
        return std::fabs(c - std::round(c / step) * step) <= 0x1p-50 * std::fabs(c);
      });
    });
  });
}

/// The rounding of coordinates is that of double, of single precision if all are single-precision numbers, or
/// a decimal place if all end there and the mesh has far more of them; at most 10^-3 of the diagonal, as
/// coordinates far from the origin may be exact nevertheless.
Extent extent_of(const Patchwork& mesh) {
  Extent extent;
  Vec low{1e300, 1e300, 1e300}, high = low * -1;
  double largest = 0;
  bool single = true;
  for (const auto& row : mesh.row)
    for (const std::uint32_t v : row) {
      const Vec x = mesh.vertex[v];
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
      for (const double c : {x.x, x.y, x.z}) {
        largest = std::max(largest, std::fabs(c));
        single = single && static_cast<double>(static_cast<float>(c)) == c;
      }
    }
  extent.diagonal = norm(high - low);
  extent.rounding = std::min(largest * (single ? 0x1p-23 : 0x1p-51), 1e-3 * extent.diagonal);
  constexpr double least_places = 1e5;
  for (double place = std::pow(10, std::floor(std::log10(extent.diagonal / least_places)));
       place > 2 * extent.rounding; place /= 10)
    if (has_step(mesh, place)) {
      extent.rounding = place;
      break;
    }
  return extent;
}

/// Counts components and boundary edges.
void count_rest(const Patchwork& mesh, RepairReport& report) {
  DisjointSets parts(mesh.vertex.size());
  std::vector<std::uint64_t> edges;
  std::vector<bool> used(mesh.vertex.size(), false);
  for (const auto& row : mesh.row)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(row[k], row[(k + 1) % 3]);
      edges.push_back(edge_key(a, b));
      parts.unite(a, b);
      used[a] = true;
    }
  for (std::uint32_t v = 0; v < used.size(); ++v) report.components += used[v] && parts.root(v) == v;
  std::sort(edges.begin(), edges.end());
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last] == edges[first]) ++last;
    report.boundary_edges += last - first == 1;
    first = last;
  }
}

std::string counted(const RepairCount& what, const char* one, const char* many) {
  return std::to_string(what.count) + " " + (what.count == 1 ? one : many);
}

/// ", the first around (x, y, z)".
std::string place(const RepairCount& what) {
  return (what.count == 1 ? ", around " : ", the first around ") + place_text(what.first.data());
}

}  // namespace

bool RepairReport::changed() const {
  return degenerate.count + repeated.count + split_edges.count + split_vertices.count + welded.count +
             turned.count + flat.count >
         0;
}

std::vector<std::string> RepairReport::acts() const {
  std::vector<std::string> acts;
  const auto add = [&](const RepairCount& what, const std::string& act) {
    if (what.count > 0) acts.push_back(act + place(what));
  };
  add(degenerate,
      "removed " + counted(degenerate, "triangle", "triangles") + " with two corners at one position");
  add(repeated,
      "removed " + counted(repeated, "triangle", "triangles") + " with the corners of an earlier one");
  add(split_edges, "split " + counted(split_edges, "edge", "edges") + " of more than two triangles");
  add(split_vertices, "split " + counted(split_vertices, "vertex", "vertices") + " where sheets touch");
  add(welded, "joined " + counted(welded, "pair", "pairs") + " of boundary edges up to " + digits(moved, 2) +
                  " apart");
  add(turned, "turned " + counted(turned, "triangle", "triangles") + " over, against their neighbours");
  add(flat,
      "removed " + counted(flat, "triangle", "triangles") + " without area or with an edge of no length");
  return acts;
}

std::vector<std::string> RepairReport::left() const {
  std::vector<std::string> left;
  if (left_flat.count > 0)
    left.push_back(counted(left_flat, "triangle", "triangles") + " without area" + place(left_flat));
  if (intersections.count > 0)
    left.push_back(counted(intersections, "pair", "pairs") + " of triangles that cross each other" +
                   place(intersections));
  return left;
}

RepairedMesh repair(std::span<const double> vertices, std::span<const std::uint32_t> triangles,
                    const RepairOptions& options) {
  const FloatEnvironment environment;
  if (std::isnan(options.weld))
    throw Error(ErrorCode::invalid_argument, "the tolerance of welding is not a number");
  check_triangles(vertices, triangles);
  RepairedMesh result;
  Patchwork mesh = patchwork_of(vertices, triangles);
  const std::vector<std::uint32_t> same = first_at_position(vertices, 3);
  const Extent extent = extent_of(mesh);
  drop_doubles(mesh, same, result.report);
  if (mesh.row.empty())
    throw Error(ErrorCode::invalid_domain, "all triangles have two corners at one position");
  const double automatic = std::max(1e-6 * extent.diagonal, 4 * extent.rounding);
  const double weld = options.weld < 0 ? automatic : options.weld;
  join_edges(mesh, same, weld, result.report);
  remove_flat(mesh, 3 * extent.rounding, std::min(weld, automatic), result.report);
  count_rest(mesh, result.report);
  result.report.intersections = crossings(mesh, extent.rounding);
  for (const Vec& x : mesh.vertex) result.mesh.vertices.insert(result.mesh.vertices.end(), {x.x, x.y, x.z});
  for (const auto& row : mesh.row)
    result.mesh.triangles.insert(result.mesh.triangles.end(), row.begin(), row.end());
  return result;
}

}  // namespace powercell
