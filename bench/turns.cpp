#include "bench/turns.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <map>
#include <stdexcept>

namespace powercell::bench {

namespace {

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_clock() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

void run_once(Contender& contender, Record& record) {
  contender.forget();
  const double cpu = cpu_clock(), start = wall_clock();
  contender.run();
  record.seconds.push_back(wall_clock() - start);
  record.cpu_seconds.push_back(cpu_clock() - cpu);
  record.relative_error = contender.relative_error();
  if (!(record.relative_error <= contender.tolerance())) {
    char error[32];
    std::snprintf(error, sizeof error, "%g", record.relative_error);
    throw std::runtime_error(record.work.name(record.stage, record.precision, record.provider) +
                             ": the sum of the measures is off by " + error);
  }
}

std::string key(const Contender& c) {
  return c.stage + ":" + c.provider;
}

/// Who is left out of the next, larger work, and why.
using Dropped = std::map<std::string, std::string>;

Dropped slow_ones(const std::vector<Record>& records, double factor) {
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

/// One work: everybody who is not dropped, in rounds.
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
  const double start = wall_clock();
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t k = 0; k < all.size(); ++k)
      if (records[k].skipped.empty()) run_once(*all[k], records[k]);
    // No round is begun that would end far beyond the time given.
    const double spent = wall_clock() - start;
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
      throw std::invalid_argument("'" + way + "' is not of the form stage:provider");
    const std::string stage = way.substr(0, colon), provider = way.substr(colon + 1);
    if ((stage != "measures" && stage != "adjacency" && stage != "weights") ||
        (provider != "tree" && provider != "flann"))
      throw std::invalid_argument("'" + way + "' names no stage or no provider");
    if (provider == "flann" && !has_flann()) throw std::invalid_argument("this is a build without FLANN");
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
    dropped = slow_ones(run_work(work, scout, {}, file), options.drop);
  }
  for (const std::size_t n : sizes) {
    work.n = n;
    // Who was dropped stays out: at larger n the lag of a poor search only grows.
    dropped.merge(slow_ones(run_work(work, options, dropped, file), options.drop));
  }
}

}  // namespace powercell::bench
