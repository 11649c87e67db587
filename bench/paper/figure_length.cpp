#include "bench/paper/figures.hpp"
#include "bench/paper/list_use.hpp"
#include "bench/workload.hpp"

namespace powercell::paper {

void length_figure(const Study& study) {
  TableFile file(
      study, "figure4",
      "L neighbours asked for at first, doubled for the cells that need more; white seeds, weights "
      "uniform in [0, h^2/2]; microseconds of processor time a seed; share of (region, seed) pairs "
      "that the first list suffices for",
      {"domain", "n", "L", "first_share", "asked", "rounds", "flann_us", "tree_us"});
  const std::size_t part = study.quick ? 10 : 1;
  const std::vector<int> flat{6, 8, 10, 12, 14, 16, 18, 20, 24, 28, 34, 40};
  const std::vector<int> solid{12, 16, 20, 24, 28, 30, 32, 35, 40, 48, 56, 64, 80};
  for (const Subject& subject : {Subject{"square", test::unit_box(2), 40000 / part},
                                 Subject{"surface", bench::domain_of("surface"), 20000 / part},
                                 Subject{"cube", test::unit_box(3), 15000 / part}}) {
    const test::SeedArray seeds = white_seeds(subject.domain, subject.n, 0.5);
    const std::vector<int>& lengths = subject.domain.cell_dimension() == 3 ? solid : flat;
    std::vector<Way> ways{tree_way()};
    for (const int length : lengths) ways.push_back(list_way(length));
    Trial trial(study.device, subject.domain, ways);
    const std::vector<Time> times = trial.run(seeds.view(), study.quick ? 2 : 7);
    for (std::size_t w = 1; w < ways.size(); ++w) {
      const ListUse use = count_list_use(study.device, subject.domain, seeds.view(), ways[w].options);
      file.row({subject.name, std::uint64_t{subject.n}, static_cast<std::uint64_t>(lengths[w - 1]),
                mean(use.pairs_per_round.front(), use.pairs), mean(use.entries, subject.n),
                std::uint64_t{use.pairs_per_round.size()}, per_seed(times[w].processor, subject.n),
                per_seed(times[0].processor, subject.n)});
    }
  }
}

}  // namespace powercell::paper
