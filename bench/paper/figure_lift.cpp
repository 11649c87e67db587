#include <algorithm>

#include "bench/paper/figures.hpp"
#include "bench/paper/list_use.hpp"

namespace powercell::paper {

namespace {

/// With the lifted seed as the query, lists grow with eta^(d/2): its factors end earlier.
constexpr double factors[] = {1, 1.25, 1.5, 2, 3, 5, 10, 30, 100};
constexpr double largest_factor_without_twin = 5;

std::vector<Way> lift_ways(double largest_weight) {
  std::vector<Way> ways{tree_way()};
  for (const bool twins : {true, false})
    for (const double factor : factors) {
      if (!twins && factor > largest_factor_without_twin) break;
      ways.push_back(list_way());
      ways.back().name = twins ? "twin" : "seed";
      ways.back().options.twin_queries = twins;
      ways.back().options.lift_eta = factor * largest_weight;
    }
  return ways;
}

}  // namespace

void lift_figure(const Study& study) {
  TableFile file(
      study, "figure3",
      "eta = factor * largest weight; lists nearest to the twin or to the lifted seed; white seeds, "
      "weights uniform in [0, range h^2]; neighbours and cuts a seed, microseconds of processor time "
      "a seed; the tree has no lift",
      {"domain", "n", "range", "query", "factor", "neighbors", "cuts", "asked", "flann_us", "tree_us"});
  const std::size_t part = study.quick ? 4 : 1;
  for (const Subject& subject :
       {Subject{"square", test::unit_box(2), 20000 / part}, Subject{"cube", test::unit_box(3), 6000 / part}})
    for (const double range : {0.5, 2.0}) {
      const test::SeedArray seeds = white_seeds(subject.domain, subject.n, range);
      const double largest = *std::max_element(seeds.weights.begin(), seeds.weights.end());
      Trial trial(study.device, subject.domain, lift_ways(largest));
      const std::vector<Time> times = trial.run(seeds.view(), study.quick ? 2 : 5);
      for (std::size_t w = 1; w < times.size(); ++w) {
        const Way& way = trial.ways()[w];
        const ListUse use = count_list_use(study.device, subject.domain, seeds.view(), way.options);
        file.row({subject.name, std::uint64_t{subject.n}, range, way.name, way.options.lift_eta / largest,
                  mean(use.tried, use.pairs), mean(use.cuts, use.pairs), mean(use.entries, subject.n),
                  per_seed(times[w].processor, subject.n), per_seed(times[0].processor, subject.n)});
      }
    }
}

}  // namespace powercell::paper
