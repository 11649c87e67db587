// Table 1 of the paper: the time of each stage over models. Writes table1.csv; see run.sh.
#include <cmath>
#include <cstdio>

#include "apps/io/read/domain.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "bench/paper/table_file.hpp"
#include "bench/paper/trial.hpp"

using namespace powercell;
using namespace powercell::paper;

namespace {

const char* kind_of(const Domain& domain) {
  return domain.kind() == DomainKind::polygon   ? "polygon"
         : domain.kind() == DomainKind::surface ? "surface"
                                                : "volume";
}

/// Names of the models with what read_domain takes.
struct Model {
  const char* name;
  std::string spec;
};

const std::vector<Model>& models() {
  const std::string data = POWERCELL_DATA_FOLDER "/";
  static const std::vector<Model> list = {
      {"square", "square"},    {"disk", "disk:1000"}, {"Italy", data + "italy.geojson"},
      {"sphere", "sphere:16"}, {"torus", "torus:32"}, {"pretzel", data + "pretzel.off"},
      {"cube", "cube"},        {"ball", "ball:12"},   {"bracket", data + "bracket.mesh"},
  };
  return list;
}

void table(const Study& study) {
  TableFile file(
      study, "table1",
      "seeds uniform in measure, weights uniform in [0, h^2/2]; wall seconds of the stages and of all, "
      "microseconds of processor time a seed; regions and (region, seed) pairs counted",
      {"model", "kind", "regions", "n", "hidden", "pairs", "provider", "prepare_s", "pairs_s", "neighbors_s",
       "clip_s", "total_s", "us", "relative_error"});
  const std::vector<std::uint64_t> sizes =
      study.quick ? std::vector<std::uint64_t>{2000} : std::vector<std::uint64_t>{5000, 100000};
  for (const Model& model : models()) {
    std::fprintf(stderr, "table1: %s ...\n", model.name);
    const Domain domain = io::read_domain(model.spec).domain;
    Trial trial(study.device, domain, {list_way(), tree_way()});
    for (const std::uint64_t n : sizes) {
      const double h = std::pow(domain.measure() / static_cast<double>(n), 1.0 / domain.cell_dimension());
      const io::SeedTable seeds = io::random_seeds({n, 0, 0.5 * h * h, 1}, domain);
      const std::vector<Time> times =
          trial.run({seeds.dimension, seeds.positions, seeds.weights}, n < 30000 ? 3 : 2);
      for (std::size_t w = 0; w < times.size(); ++w) {
        const Timings& t = times[w].timings;
        file.row({std::string(model.name), std::string(kind_of(domain)), std::uint64_t{domain.region_count()},
                  n, std::uint64_t{trial.hidden()}, t.pair_count, trial.ways()[w].name, t.prepare, t.pairs,
                  t.neighbors, t.clip, t.total, 1e6 * times[w].processor / static_cast<double>(n),
                  trial.relative_error(w)});
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    table(parse_command(argc, argv).study);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "paper_models: %s\n", error.what());
    return 1;
  }
  return 0;
}
