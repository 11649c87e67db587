#include "apps/io/picture/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/io/picture/colours.hpp"
#include "apps/io/picture/frame.hpp"
#include "apps/io/picture/outline.hpp"
#include "apps/io/picture/periodic.hpp"
#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

constexpr std::size_t most_labels = 10'000;  // more would double the size of the SVG

// Maps coordinates of the domain to the picture.
struct Placement {
  double scale = 1;  // pixels per unit
  double left = 0, top = 0;
  double low_x = 0, high_y = 0;
  double x(double at) const { return left + (at - low_x) * scale; }
  double y(double at) const { return top + (high_y - at) * scale; }
};

// Of a drawing in its room, with a margin; and the size that it has.
Placement place(const DiagramOutput& output, const PictureRoom& room, double margin, double& drawing_width,
                double& drawing_height) {
  const auto low = output.domain.low(), high = output.domain.high();
  const double wide = std::max(high[0] - low[0], 1e-300), tall = std::max(high[1] - low[1], 1e-300);
  Placement placement;
  placement.scale = std::min((room.width - 2 * margin) / wide, (room.height - 2 * margin) / tall);
  placement.left = placement.top = margin;
  placement.low_x = low[0];
  placement.high_y = high[1];
  // A very thin domain still gets a picture of some pixels in height.
  drawing_width = std::ceil(2 * margin + std::max(1.0, (high[0] - low[0]) * placement.scale));
  drawing_height = std::ceil(2 * margin + std::max(1.0, (high[1] - low[1]) * placement.scale));
  return placement;
}

std::string label(const DiagramOutput& output, std::size_t i) {
  const double w = output.seeds.weights.empty() ? 0.0 : output.seeds.weights[i];
  std::string text = fmt::format("seed {}: weight {:.6g}, area {:.6g}", i, w, output.measures.mass[i]);
  const ColourBy& by = output.style.colours;
  if (by.what == ColourBy::What::column)
    text += fmt::format(", {}: {}", printable(by.column.name),
                        printable(std::string(output.inputs.table->text.field(i, by.column.index))));
  return text;
}

FlatBox box_of(const JoinedCells& joined, std::size_t cell) {
  FlatBox box;
  for (std::uint64_t v = joined.vertex_offset[cell]; v < joined.vertex_offset[cell + 1]; ++v)
    box.add(&joined.vertices[2 * v]);
  return box;
}

void add_cells(Scene& scene, const DiagramOutput& output, const Colouring& colouring,
               const Placement& placement) {
  const JoinedCells& joined = output.joined;
  const std::size_t n = output.measures.mass.size();
  for (std::size_t i = 0; i + 1 < joined.face_offset.size(); ++i) {
    if (joined.face_offset[i] == joined.face_offset[i + 1]) continue;
    Scene::Cell cell{static_cast<std::uint32_t>(i), colouring.colour[i], scene.cell_rings.size(), 0, {}};
    cell.striped = colouring.is_striped(i);
    scene.has_stripes = scene.has_stripes || cell.striped;
    for (const Translation& by : translations_into_view(output.domain, box_of(joined, i)))
      for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f) {
        for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e) {
          const double* v = &joined.vertices[2 * (joined.vertex_offset[i] + joined.loop[e])];
          scene.cell_rings.add(placement.x(v[0] + by[0]), placement.y(v[1] + by[1]));
        }
        scene.cell_rings.end_ring();
      }
    cell.end_ring = scene.cell_rings.size();
    if (n <= most_labels) cell.label = label(output, i);
    scene.cells.push_back(std::move(cell));
  }
}

// How much larger than true discs of radius sqrt|w| are drawn: 1 where they are legible, else such that the
// larger ones fill about half of a cell. `spacing` is the width of a mean cell.
double disc_magnification(const SeedsView& seeds, double spacing) {
  std::vector<double> radii;
  for (const double w : seeds.weights) {
    if (w != 0) radii.push_back(std::sqrt(std::abs(w)));
  }
  if (radii.empty() || !(spacing > 0)) return 1;
  const auto large = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() * 9 / 10);
  std::nth_element(radii.begin(), large, radii.end());
  const double relative = *large / spacing;
  return relative > 0.12 && relative < 1.0 ? 1 : 0.45 / relative;
}

// Weights may be shown as discs, which would darken colours that mean something.
bool shows_weights(const DiagramOutput& output) {
  return output.weights_as_discs && output.style.colours.what == ColourBy::What::hues;
}

// Discs of the weights, if they are wanted, largest first, then the dots of the seeds, then those without a
// cell. Seeds outside the picture are left out.
std::vector<Scene::Disc> make_discs(const DiagramOutput& output, const Placement& placement,
                                    const Scene& scene, double spacing, double magnification,
                                    double enlargement) {
  std::vector<Scene::Disc> weights, dots, without_cell;
  const double dot =
      std::clamp(0.045 * spacing * placement.scale, std::min(0.8, 0.8 * enlargement), 3.2 * enlargement);
  for (std::size_t i = 0; i < output.seeds.size(); ++i) {
    FlatBox at;
    at.add(&output.seeds.positions[2 * i]);
    // In a periodic domain the image of the seed in the picture.
    const std::vector<Translation> into = translations_into_view(output.domain, at);
    if (into.empty()) continue;
    const double x = placement.x(at.low[0] + into.front()[0]);
    const double y = placement.y(at.low[1] + into.front()[1]);
    if (!(x >= 0 && x <= scene.width && y >= 0 && y <= scene.height)) continue;
    const auto seed = static_cast<std::uint32_t>(i);
    const SeedStatus status = output.measures.status[i];
    if (status == SeedStatus::hidden) without_cell.push_back({Scene::Mark::hidden, seed, x, y, 1.35 * dot});
    if (status == SeedStatus::duplicate) {
      without_cell.push_back({Scene::Mark::duplicate, seed, x, y, 1.9 * dot});
    }
    if (status != SeedStatus::ok) continue;
    dots.push_back({Scene::Mark::dot, seed, x, y, dot});
    if (!shows_weights(output) || output.seeds.weights.empty()) continue;
    const double w = output.seeds.weights[i];
    const double radius = std::sqrt(std::abs(w)) * magnification * placement.scale;
    if (radius < 1.3 * dot) continue;
    weights.push_back({w > 0 ? Scene::Mark::positive : Scene::Mark::negative, seed, x, y, radius});
  }
  std::stable_sort(weights.begin(), weights.end(),
                   [](const Scene::Disc& a, const Scene::Disc& b) { return a.radius > b.radius; });
  weights.insert(weights.end(), dots.begin(), dots.end());
  weights.insert(weights.end(), without_cell.begin(), without_cell.end());
  return weights;
}

void describe(Scene& scene, const DiagramOutput& output, const Legend& legend, double magnification,
              bool discs) {
  const Measures& measures = output.measures;
  scene.title = fmt::format("Power diagram of {} seeds", output.seeds.size());
  scene.description = fmt::format("{} cells, {} hidden seeds, {} duplicate seeds.", scene.cells.size(),
                                  measures.count(SeedStatus::hidden), measures.count(SeedStatus::duplicate));
  if (!legend.title.empty()) scene.description += fmt::format(" Colours show: {}.", legend.title);
  if (!discs) return;
  if (shows_weights(output))
    scene.description +=
        " A disc around a seed has the radius sqrt(weight); a dashed ring stands for a negative weight.";
  scene.description += " A hollow dot stands for a hidden seed, a cross for a duplicate.";
  if (shows_weights(output) && magnification != 1) {
    scene.description += fmt::format(" Radii are drawn {:.4g} times their size.", magnification);
  }
}

}  // namespace

Scene make_scene(const DiagramOutput& output) {
  const Colouring colouring = colouring_of(output);
  PictureFrame frame(output.style.size, colouring.legend);
  Scene scene;
  double width = 0, height = 0;
  Placement placement =
      place(output, frame.room(), 0.02 * std::min(frame.room().width, frame.room().height), width, height);
  frame.place(width, height);
  placement.left += frame.left();
  placement.top += frame.top();
  scene.width = frame.width();
  scene.height = frame.height();
  scene.legend = frame.legend();
  scene.units_per_inch = output.style.size.points ? 72 : 96;
  scene.stripes = stripe_distance(frame.long_side());
  add_cells(scene, output, colouring, placement);
  for (const Ring& ring : boundary_rings(output.domain)) {
    for (const auto& point : ring) scene.outline.add(placement.x(point[0]), placement.y(point[1]));
    scene.outline.end_ring();
  }
  const double cells = static_cast<double>(std::max<std::size_t>(scene.cells.size(), 1));
  const double spacing = std::sqrt(output.domain.measure() / cells);
  // Between cells of a few pixels the soft edges of the fills are enough.
  const double pixels = spacing * placement.scale, enlargement = frame.enlargement();
  scene.wall_width = pixels < 4 ? 0 : std::clamp(0.035 * pixels, 0.3, std::max(0.3, 2.6 * enlargement));
  scene.outline_width =
      std::clamp(1.6 * scene.wall_width, std::min(1.2, 2.4 * enlargement), std::max(1.2, 3.6 * enlargement));
  scene.disc_line = std::clamp(0.02 * pixels, 0.5, std::max(0.5, 1.6 * enlargement));
  const bool discs = output.seeds.size() <= most_discs;
  const double magnification = disc_magnification(output.seeds, spacing);
  if (discs) scene.discs = make_discs(output, placement, scene, spacing, magnification, enlargement);
  describe(scene, output, colouring.legend, magnification, discs);
  return scene;
}

}  // namespace powercell::io
