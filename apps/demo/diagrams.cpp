// The diagrams of the demo: a map, a surface and a volume.
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "apps/demo/parts.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "apps/outputs.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

struct DiagramPlan {
  std::string shape;  // "italy.geojson"
  std::size_t seeds;
  std::vector<std::string> extensions;  // pictures first; geometry for other programs beside them
};

// Moves the seeds to the centroids of their cells a few times, which gives cells of even size, as in a foam.
void relax(Diagram& diagram, std::vector<double>& positions, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    diagram.set_seeds({diagram.domain().dimension(), positions, {}});
    compute([&] { diagram.measures(); });
    const Measures& measures = diagram.measures();
    for (std::size_t k = 0; k < positions.size(); ++k)
      if (!std::isnan(measures.centroid[k])) positions[k] = measures.centroid[k];
  }
}

// Discs of different radii, one in 60 large enough to hide neighbours.
std::vector<double> weights_of_discs(const Domain& domain, std::size_t count) {
  const double spacing =
      std::pow(domain.measure() / static_cast<double>(count), 1.0 / domain.cell_dimension());
  std::mt19937_64 random(3);
  // From the generator's bits: the standard library's distributions differ between machines.
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<double> weights(count);
  for (double& weight : weights) {
    const double radius = spacing * (unit() < 1.0 / 60 ? 1.5 : 0.1 + 0.5 * unit());
    weight = radius * radius;
  }
  return weights;
}

void write_seeds(const std::string& path, const SeedsView& seeds) {
  io::AtomicFile file(path);
  file.write(seeds.dimension == 2 ? "x,y,weight\n" : "x,y,z,weight\n");
  const auto d = static_cast<std::size_t>(seeds.dimension);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    for (std::size_t k = 0; k < d; ++k) {
      file.number(seeds.positions[d * i + k]);
      file.write(',');
    }
    file.number(seeds.weights[i]);
    file.write('\n');
  }
  file.commit();
}

DemoPart draw_diagram(const DemoSetting& setting, const Device& device, const DiagramPlan& plan) {
  const std::filesystem::path shape = setting.folder / plan.shape;
  const std::string stem = std::filesystem::path(shape).replace_extension().string();
  const io::LoadedDomain domain = io::read_domain(shape.string());
  Diagram diagram(device, domain.domain, library_options(setting.options));
  std::vector<double> positions = io::random_seeds({plan.seeds, 0, 0, 1}, domain.domain).positions;
  relax(diagram, positions, 8);
  const std::vector<double> weights = weights_of_discs(domain.domain, plan.seeds);
  const SeedsView seeds{domain.domain.dimension(), positions, weights};
  diagram.set_seeds(seeds);
  compute([&] { diagram.compute(true, true); });
  RunReport report = report_of(diagram);
  require_partition(report);

  const std::string seeds_path = stem + "-seeds.csv";
  write_seeds(seeds_path, seeds);
  for (const std::string& extension : plan.extensions) report.files.push_back(stem + extension);
  write_diagram(report.files, diagram, seeds);

  DemoPart part;
  part.name = std::filesystem::path(plan.shape).stem().string();
  part.command = fmt::format("powercell diagram --domain {} --seeds {}-seeds.csv -o {}.png", plan.shape,
                             part.name, part.name);
  part.topic = "diagram";
  part.files = report.files;
  part.files.push_back(seeds_path);
  const double defect = report.measure / report.domain_measure - 1;
  part.figures = {
      {"cells", with_commas(report.cells)},
      {"hidden", with_commas(report.hidden)},
      {"measures / domain", fmt::format("1 {} {:.1e}", defect < 0 ? "−" : "+", std::abs(defect))}};
  part.line =
      fmt::format("{} cells, {} hidden; sum of measures / domain = 1 {} {:.1e}", with_commas(report.cells),
                  with_commas(report.hidden), defect < 0 ? '-' : '+', std::abs(defect));
  part.report = as_json(report);
  return part;
}

}  // namespace

DemoPart draw_map(const DemoSetting& setting, const Device* device) {
  DemoPart part = draw_diagram(setting, *device, {"italy.geojson", 700, {".png", ".svg"}});
  part.title = "A diagram of a map";
  part.caption =
      "Italy with its islands, 700 seeds. Each disc is a seed’s weight: a weight is a squared length, and "
      "the disc of "
      "radius √w shows it. Where two discs cross, the border of their cells runs through the crossings. "
      "Hollow dots "
      "are hidden seeds: so light beside a neighbour that no place is left for them. San Marino is a hole.";
  part.shown = "Italy divided into cells of many colours, with a disc in each";
  part.document = "docs/guide.md#weights-and-the-power-distance";
  part.document_title = "Weights and the power distance";
  return part;
}

DemoPart draw_surface(const DemoSetting& setting, const Device* device) {
  DemoPart part = draw_diagram(setting, *device, {"pretzel.off", 900, {".png", ".vtu"}});
  part.title = "On a surface";
  part.caption =
      "A closed surface with three holes, in 900 cells. The cells are pieces of the surface itself: its "
      "triangles are "
      "cut where the planes between two seeds pass. Weights are as on the map; here they are balls, and not "
      "drawn.";
  part.shown = "A pretzel of three holes, its surface divided into cells of many colours";
  part.document = "docs/guide.md#domains";
  part.document_title = "Domains";
  return part;
}

DemoPart draw_volume(const DemoSetting& setting, const Device* device) {
  DemoPart part = draw_diagram(setting, *device, {"bracket.mesh", 500, {".png", ".vtu"}});
  part.title = "In a volume";
  part.caption =
      "A machine part of 12,000 tetrahedra in 500 cells, cut open to show those inside. Cells end at the "
      "part’s own "
      "boundary, with its bores; measures are volumes. Open bracket.vtu in ParaView.";
  part.shown = "A bracket with bores, cut open, its inside divided into cells of many colours";
  part.document = "docs/guide.md#domains";
  part.document_title = "Domains";
  return part;
}

}  // namespace powercell::app
