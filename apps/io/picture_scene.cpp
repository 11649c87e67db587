#include "apps/io/picture_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/io/picture_discs.hpp"
#include "apps/io/picture_outline.hpp"

namespace powercell::io {
namespace {

constexpr std::size_t most_discs = 20'000;   // more would be a blur
constexpr std::size_t most_labels = 10'000;  // more would make the SVG twice as large

Placement place(const DiagramOutput& output, double long_side, Scene& scene) {
  const auto low = output.domain.low(), high = output.domain.high();
  const double margin = 0.02 * long_side;
  const double extent = std::max({high[0] - low[0], high[1] - low[1], 1e-300});
  Placement placement;
  placement.scale = (long_side - 2 * margin) / extent;
  placement.left = placement.top = margin;
  placement.low_x = low[0];
  placement.high_y = high[1];
  // A strip-like domain still gets a picture some pixels high.
  scene.width = std::ceil(2 * margin + std::max(1.0, (high[0] - low[0]) * placement.scale));
  scene.height = std::ceil(2 * margin + std::max(1.0, (high[1] - low[1]) * placement.scale));
  return placement;
}

std::string label(const DiagramOutput& output, std::size_t i) {
  const double w = output.seeds.weights.empty() ? 0.0 : output.seeds.weights[i];
  return fmt::format("seed {}: weight {:.6g}, area {:.6g}", i, w, output.measures.mass[i]);
}

void add_cells(Scene& scene, const DiagramOutput& output, const Placement& placement) {
  const JoinedCells& joined = output.joined;
  const std::size_t n = output.measures.mass.size();
  const std::vector<Colour> colours = cell_colours(output.adjacency, n);
  for (std::size_t i = 0; i + 1 < joined.face_offset.size(); ++i) {
    if (joined.face_offset[i] == joined.face_offset[i + 1]) continue;
    Scene::Cell cell{static_cast<std::uint32_t>(i), colours[i], scene.cell_rings.size(), 0, {}};
    for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f) {
      for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e) {
        const double* v = &joined.vertices[2 * (joined.vertex_offset[i] + joined.loop[e])];
        scene.cell_rings.add(placement.x(v[0]), placement.y(v[1]));
      }
      scene.cell_rings.end_ring();
    }
    cell.end_ring = scene.cell_rings.size();
    if (n <= most_labels) cell.label = label(output, i);
    scene.cells.push_back(std::move(cell));
  }
}

void describe(Scene& scene, const DiagramOutput& output, double magnification, bool discs) {
  const Measures& measures = output.measures;
  scene.title = fmt::format("Power diagram of {} seeds", output.seeds.size());
  scene.description = fmt::format("{} cells, {} hidden seeds, {} duplicate seeds.", scene.cells.size(),
                                  measures.count(SeedStatus::hidden), measures.count(SeedStatus::duplicate));
  if (!discs) return;
  if (output.weights_as_discs)
    scene.description +=
        " A disc around a seed has the radius sqrt(weight); a dashed ring stands for a negative weight.";
  scene.description += " A hollow dot stands for a hidden seed, a cross for a duplicate.";
  if (output.weights_as_discs && magnification != 1) {
    scene.description += fmt::format(" Radii are drawn {:.4g} times their size.", magnification);
  }
}

}  // namespace

Scene make_scene(const DiagramOutput& output, double long_side) {
  Scene scene;
  const Placement placement = place(output, long_side, scene);
  add_cells(scene, output, placement);
  for (const Ring& ring : boundary_rings(output.domain)) {
    for (const auto& point : ring) scene.outline.add(placement.x(point[0]), placement.y(point[1]));
    scene.outline.end_ring();
  }
  const double cells = static_cast<double>(std::max<std::size_t>(scene.cells.size(), 1));
  const double spacing = std::sqrt(output.domain.measure() / cells);
  // Between cells of a few pixels the soft edges of the fills are wall enough.
  const double pixels = spacing * placement.scale;
  scene.wall_width = pixels < 4 ? 0 : std::clamp(0.035 * pixels, 0.3, 2.6);
  scene.outline_width = std::clamp(1.6 * scene.wall_width, 1.2, 3.6);
  scene.disc_line = std::clamp(0.02 * pixels, 0.5, 1.6);
  const bool discs = output.seeds.size() <= most_discs;
  const double magnification = disc_magnification(output.seeds, spacing);
  if (discs) {
    scene.discs = make_discs(output, placement, scene.width, scene.height, spacing, magnification);
  }
  describe(scene, output, magnification, discs);
  return scene;
}

}  // namespace powercell::io
