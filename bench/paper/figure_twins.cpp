#include "bench/paper/figures.hpp"
#include "bench/paper/list_use.hpp"

namespace powercell::paper {

void twins_figure(const Study& study) {
  TableFile file(study, "figure6",
                 "lists nearest to the twin or to the lifted seed itself; white seeds, weights uniform in "
                 "[0, range h^2]; neighbours and cuts a seed, microseconds of processor time a seed",
                 {"domain", "n", "range", "query", "neighbors", "cuts", "asked", "rounds", "hidden",
                  "flann_us", "tree_us"});
  const std::size_t part = study.quick ? 10 : 1;
  for (const Subject& subject :
       {Subject{"square", test::unit_box(2), 20000 / part}, Subject{"cube", test::unit_box(3), 10000 / part}})
    for (const double range : {0.0, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0}) {
      const test::SeedArray seeds = white_seeds(subject.domain, subject.n, range);
      std::vector<Way> ways{tree_way(), list_way(), list_way()};
      ways[1].name = "twin";
      ways[2].name = "seed";
      ways[2].options.twin_queries = false;
      Trial trial(study.device, subject.domain, ways);
      const std::vector<Time> times = trial.run(seeds.view(), study.quick ? 2 : 5);
      for (std::size_t w = 1; w < ways.size(); ++w) {
        const ListUse use = count_list_use(study.device, subject.domain, seeds.view(), ways[w].options);
        file.row({subject.name, std::uint64_t{subject.n}, range, ways[w].name, mean(use.tried, use.pairs),
                  mean(use.cuts, use.pairs), mean(use.entries, subject.n),
                  std::uint64_t{use.pairs_per_round.size()}, mean(trial.hidden(), subject.n),
                  per_seed(times[w].processor, subject.n), per_seed(times[0].processor, subject.n)});
      }
    }
}

}  // namespace powercell::paper
