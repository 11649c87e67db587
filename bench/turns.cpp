#include "bench/turns.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <stdexcept>

#include "bench/clocks.hpp"

namespace powercell::bench {

namespace {

void run_once(Contender& contender, Record& record) {
  contender.forget();
  const double cpu = processor_seconds(), start = wall_seconds();
  contender.run();
  record.seconds.push_back(wall_seconds() - start);
  record.cpu_seconds.push_back(processor_seconds() - cpu);
  record.relative_error = contender.relative_error();
  if (!(record.relative_error <= contender.tolerance())) {
    char error[32];
    std::snprintf(error, sizeof error, "%g", record.relative_error);
    throw std::runtime_error(record.work.name(record.stage, record.precision, record.provider) +
                             ": the sum of the measures has a relative error of " + error);
  }
}

std::string key(const Contender& c) {
  return c.stage + ":" + c.provider;
}

/// By stage:provider, why a contender is left out of the next, larger work.
using Dropped = std::map<std::string, std::string>;

Dropped slow_contenders(const std::vector<Record>& records, double factor) {
  double best = std::numeric_limits<double>::infinity();
  std::string best_name;
  for (const Record& r : records)
    if (r.peer && r.least() < best) best = r.least(), best_name = r.provider;
  Dropped dropped;
  for (const Record& r : records) {
    if (factor <= 0 || r.work.n < 10000 || r.seconds.empty() || !(r.peer || r.provider == "flann")) continue;
    if (!(r.least() > (r.work.n < 100000 ? 2 : 1) * factor * best)) continue;
    char text[160];
    std::snprintf(text, sizeof text, "%.1f times as long as %s at n = %zu", r.least() / best,
                  best_name.c_str(), r.work.n);
    dropped[r.stage + ":" + r.provider] = text;
  }
  return dropped;
}

/// Runs one work: all contenders that are not dropped, in rounds.
std::vector<Record> run_work(const Work& work, const TurnOptions& options, const Dropped& dropped,
                             RecordFile& file) {
  const Domain domain = domain_of(work.domain);
  const SeedArray seeds = seeds_of(work);
  auto all = contenders(work, domain, seeds, options);
  std::vector<Record> records;
  for (const auto& c : all) {
    records.emplace_back(options.part, work, *c);
    const auto found = dropped.find(key(*c));
    if (found != dropped.end())
      records.back().skipped = found->second;
    else
      c->prepare();
  }
  const double start = wall_seconds();
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t k = 0; k < all.size(); ++k)
      if (records[k].skipped.empty()) run_once(*all[k], records[k]);
    // Begin no round that would end long after the time limit.
    const double spent = wall_seconds() - start;
    if (round + 1 >= options.least_rounds && spent + 0.5 * spent / (round + 1) > options.seconds) break;
  }
  for (const Record& r : records) file.add(r);
  return records;
}

}  // namespace

std::vector<std::unique_ptr<Contender>> contenders(const Work& work, const Domain& domain,
                                                   const SeedArray& seeds, const TurnOptions& options) {
  std::vector<std::unique_ptr<Contender>> all;
  for (const std::string& way : options.ours) {
    const std::size_t colon = way.find(':');
    if (colon == std::string::npos)
      throw std::invalid_argument("'" + way + "' does not have the form stage:provider");
    const std::string stage = way.substr(0, colon), provider = way.substr(colon + 1);
    if ((stage != "measures" && stage != "adjacency" && stage != "weights" && stage != "periodic") ||
        (provider != "tree" && provider != "flann"))
      throw std::invalid_argument("'" + way + "' has an unknown stage or provider");
    if (provider == "flann" && !has_flann())
      throw std::invalid_argument("the provider flann needs a build with FLANN");
    all.push_back(our_contender(stage, provider, options.precision, domain, seeds));
  }
  const std::vector<std::string>& only = options.only_peers;
  for (const std::string& peer : peers_of(work.domain))
    if (options.peers && (only.empty() || std::find(only.begin(), only.end(), peer) != only.end()))
      all.push_back(peer_contender(peer, work, domain.measure(), seeds));
  return all;
}

void run_series(Work work, std::vector<std::size_t> sizes, const TurnOptions& options, RecordFile& file) {
  std::sort(sizes.begin(), sizes.end());
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  Dropped dropped;
  if (options.drop > 0 && !sizes.empty() && sizes.front() >= 50000) {
    TurnOptions scout = options;
    scout.part = "scout";
    scout.rounds = 2;
    scout.least_rounds = 1;
    work.n = sizes.front() / 10;
    dropped = slow_contenders(run_work(work, scout, {}, file), options.drop);
  }
  for (const std::size_t n : sizes) {
    work.n = n;
    // A contender that was dropped stays out: a slow search only falls behind further for larger n.
    dropped.merge(slow_contenders(run_work(work, options, dropped, file), options.drop));
  }
}

}  // namespace powercell::bench
