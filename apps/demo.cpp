// powercell demo: pictures of three real shapes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "apps/common.hpp"
#include "apps/demo_data.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/io/read_domain.hpp"
#include "apps/io/read_seeds.hpp"
#include "apps/outputs.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

namespace fs = std::filesystem;

struct DemoArguments : CommonOptions {
  std::string folder = "powercell-demo";
};

struct Plan {
  std::size_t seeds;
  std::vector<std::string> extensions;  ///< of the files written beside each other
};

// Pictures first; geometry for other programs beside them.
Plan plan_for(DomainKind kind) {
  switch (kind) {
    case DomainKind::polygon:
      return {700, {".png", ".svg"}};
    case DomainKind::surface:
      return {900, {".png", ".vtu"}};
    case DomainKind::volume:
      break;
  }
  return {500, {".png", ".vtu"}};
}

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

void write_text(const fs::path& path, std::string_view text) {
  io::AtomicFile file(path.string());
  file.write(text);
  file.commit();
}

void write_seeds(const fs::path& path, const SeedsView& seeds) {
  io::AtomicFile file(path.string());
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

constexpr const char* drawing = "drawing";

// In the part of the stage that begins at `from`. Each of the diagrams and then the files take a share of it.
RunReport draw(const DemoArguments& arguments, const Device& device, const DemoShape& shape, double from,
               double part, Progress& progress) {
  constexpr double read_done = 0.05, relaxed = 0.5, computed = 0.6;
  const auto part_of = [&](double begin, double end) {
    progress.part(from + begin * part, from + end * part);
  };
  const double start = progress.seconds(drawing), run_start = progress.run();
  const fs::path shape_path = fs::path(arguments.folder) / shape.file;
  const fs::path stem = fs::path(shape_path).replace_extension();
  write_text(shape_path, shape.text);
  const io::LoadedDomain domain = io::read_domain(shape_path.string());
  const double read = progress.seconds(drawing) - start;
  const Plan plan = plan_for(domain.domain.kind());

  Diagram diagram(device, domain.domain, library_options(arguments, progress));
  std::vector<double> positions = io::random_seeds({plan.seeds, 0, 0, 1}, domain.domain).positions;
  part_of(read_done, relaxed);
  relax(diagram, positions, 8);
  part_of(relaxed, computed);
  const std::vector<double> weights = weights_of_discs(domain.domain, plan.seeds);
  const SeedsView seeds{domain.domain.dimension(), positions, weights};
  diagram.set_seeds(seeds);
  compute([&] { diagram.measures(); });
  RunReport report = report_of(diagram);
  report.read = read;
  require_partition(report);
  compute([&] {
    diagram.adjacency();
    diagram.cells();
  });

  const double before = progress.seconds(drawing);
  const std::string seeds_path = stem.string() + "-seeds.csv";
  write_seeds(seeds_path, seeds);
  for (const std::string& extension : plan.extensions) report.files.push_back(stem.string() + extension);
  write_diagram(report.files, diagram, seeds);
  report.write = progress.seconds(drawing) - before;
  report.run = progress.run() - run_start;
  return report;
}

void write_page(const fs::path& path) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>powercell demo</title>\n"
      "<style>body{font-family:sans-serif;max-width:70em;margin:2em auto;color:#222}"
      "img{max-width:100%;border:1px solid #ddd}</style></head>\n<body><h1>powercell demo</h1>\n";
  for (const DemoShape& shape : demo_shapes()) {
    const std::string stem = fs::path(shape.file).stem().string();
    page += fmt::format("<h2>{}: {}</h2>\n<p><img src=\"{}.png\" alt=\"{}\"></p>\n", stem, shape.description,
                        stem, stem);
  }
  write_text(path, page + "</body></html>\n");
}

void make_folder(const std::string& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem || !fs::is_directory(folder))
    throw Error(ErrorCode::write_failed,
                fmt::format("the folder '{}' cannot be created: {}; choose another one with -o", folder,
                            problem ? problem.message() : "a file of that name exists"));
}

void print(const DemoShape& shape, const RunReport& report) {
  fmt::print("{}: {}\n  {}\n  wrote", shape.file, shape.description, self_check_line(report));
  for (const std::string& path : report.files) fmt::print(" {}", path);
  fmt::print("\n");
  std::fflush(stdout);
}

int run(const DemoArguments& arguments) {
  Progress progress({{stage::opening, 3}, {drawing, 97}}, arguments.silent());
  make_folder(arguments.folder);
  const Device device = open_device(arguments);
  const bool talk = !arguments.silent();
  if (talk)
    progress.aside([&] { fmt::print("device {} ({})\n", device.info().name, device.info().platform_name); });
  progress.begin(drawing);
  const double part = 1 / static_cast<double>(demo_shapes().size());
  nlohmann::json shapes = nlohmann::json::array();
  for (const DemoShape& shape : demo_shapes()) {
    const RunReport report =
        draw(arguments, device, shape, part * static_cast<double>(shapes.size()), part, progress);
    if (talk) progress.aside([&] { print(shape, report); });
    shapes.push_back(as_json(report));
    shapes.back()["shape"] = shape.file;
  }
  const fs::path page = fs::path(arguments.folder) / "index.html";
  write_page(page);
  progress.finish();
  const double seconds = progress.run();
  if (arguments.json)
    fmt::print("{}\n", json_text({{"shapes", shapes},
                                  {"open", page.string()},
                                  {"build", progress.build()},
                                  {"seconds", seconds},
                                  {"version", version()}}));
  if (talk)
    fmt::print(
        "{:.1f} s in all, {:.1f} s of them building kernels (kept for the next run)\n"
        "Open {}\n"
        "The same by hand: powercell diagram --domain {}/italy.geojson --seeds {}/italy-seeds.csv -o "
        "map.png\n",
        seconds, progress.build(), page.string(), arguments.folder, arguments.folder);
  return 0;
}

}  // namespace

Command add_demo(CLI::App& app) {
  auto arguments = std::make_shared<DemoArguments>();
  CLI::App* command = app.add_subcommand("demo", "Draw power diagrams of three real shapes");
  command->add_option("-o,--output", arguments->folder, "Folder to write into")
      ->type_name("FOLDER")
      ->capture_default_str();
  add_common_options(*command, *arguments);
  command->footer("Examples:\n  powercell demo\n  powercell demo -o /tmp/pictures --device gpu");
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
