#include "lib/exchange/redistribution.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "lib/base/positions.hpp"
#include "lib/seeds/hilbert.hpp"

namespace powercell::exchange {
namespace {

/// A place along the curve. Seeds in one cell of its grid follow each other by their ids, so that any number
/// of them can be divided.
using Place = std::pair<std::uint64_t, std::uint64_t>;

struct Bounds {
  std::vector<double> low, high;  ///< empty if there are no seeds
};

Bounds bounds_of(const SeedsView& seeds) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  Bounds box;
  for (std::size_t at = 0; at < seeds.positions.size(); at += d) {
    const double* const p = &seeds.positions[at];
    if (box.low.empty()) box.low.assign(p, p + d), box.high = box.low;
    for (std::size_t k = 0; k < d; ++k) {
      box.low[k] = std::min(box.low[k], p[k]);
      box.high[k] = std::max(box.high[k], p[k]);
    }
  }
  return box;
}

Bounds bounds_of_all(const SeedsView& seeds, Mailbox& mailbox) {
  const Bounds own = bounds_of(seeds);
  Bounds all, box;
  for (const Bytes& of_rank : mailbox.share({packed(own.low, own.high)})) {
    unpack(of_rank, box.low, box.high);
    if (all.low.empty()) all = box;
    for (std::size_t k = 0; k < box.low.size(); ++k) {
      all.low[k] = std::min(all.low[k], box.low[k]);
      all.high[k] = std::max(all.high[k], box.high[k]);
    }
  }
  return all;
}

/// The last places of all ranks but the highest, from samples of the places of each rank. Of n seeds on p
/// ranks one gets up to 2 n / (8 p + 64) more or less than n / p.
std::vector<Place> last_places(const std::vector<Place>& sorted, Mailbox& mailbox) {
  const auto ranks = static_cast<std::size_t>(mailbox.shards());
  const std::size_t samples = std::min(sorted.size(), 8 * ranks + 64);
  std::vector<std::uint64_t> key, id, count;  // of each sample: how many seeds it ends
  std::size_t before = 0;
  for (std::size_t k = 1; k <= samples; ++k) {
    const std::size_t end = sorted.size() * k / samples;
    key.push_back(sorted[end - 1].first);
    id.push_back(sorted[end - 1].second);
    count.push_back(end - std::exchange(before, end));
  }
  std::vector<std::pair<Place, std::uint64_t>> all;
  for (const Bytes& of_rank : mailbox.share({packed(key, id, count)})) {
    unpack(of_rank, key, id, count);
    for (std::size_t k = 0; k < key.size(); ++k) all.emplace_back(Place(key[k], id[k]), count[k]);
  }
  std::sort(all.begin(), all.end());
  std::uint64_t seeds = 0, passed = 0;
  for (const auto& [place, number] : all) seeds += number;
  std::vector<Place> last;
  for (const auto& [place, number] : all) {
    passed += number;
    while (last.size() + 1 < ranks && passed * ranks >= (last.size() + 1) * seeds) last.push_back(place);
  }
  return last;
}

struct Rows {
  std::vector<double> mass, centroid, second_moment, wall;
  std::vector<SeedStatus> status;
  std::vector<std::uint64_t> count, neighbor;  ///< `count`: of neighbours, per row
  std::vector<Shift> shift;
};

Rows rows_of(const DistributedCells& cells, std::size_t begin, std::size_t end) {
  const auto part = [](const auto& values, std::size_t first, std::size_t last) {
    return std::vector(values.begin() + static_cast<std::ptrdiff_t>(first),
                       values.begin() + static_cast<std::ptrdiff_t>(last));
  };
  const auto d = static_cast<std::size_t>(cells.measures.dimension);
  const std::size_t first = cells.offset[begin], last = cells.offset[end];
  Rows rows{part(cells.measures.mass, begin, end),
            part(cells.measures.centroid, begin * d, end * d),
            part(cells.measures.second_moment, begin, end),
            part(cells.wall, first, last),
            part(cells.measures.status, begin, end),
            {},
            part(cells.neighbor, first, last),
            cells.shift.empty() ? std::vector<Shift>{} : part(cells.shift, first, last)};
  for (std::size_t i = begin; i < end; ++i) rows.count.push_back(cells.offset[i + 1] - cells.offset[i]);
  return rows;
}

/// Puts rows of other ranks into the order of the seeds given.
class Gather {
 public:
  /// \param given  by rank: the indices of the rows that come from it
  Gather(const std::vector<std::vector<std::size_t>>& given, int dimension) : given_(given) {
    std::size_t count = 0;
    for (const std::vector<std::size_t>& indices : given) count += indices.size();
    const auto d = static_cast<std::size_t>(dimension);
    cells_.offset.resize(count + 1);
    cells_.measures.dimension = dimension;
    cells_.measures.mass.resize(count);
    cells_.measures.centroid.resize(count * d);
    cells_.measures.second_moment.resize(count);
    cells_.measures.status.resize(count);
  }

  void take(std::size_t rank, const Bytes& letter) {
    Rows& rows = rows_[rank];
    unpack(letter, rows.mass, rows.centroid, rows.second_moment, rows.wall, rows.status, rows.count,
           rows.neighbor, rows.shift);
    const std::vector<std::size_t>& given = given_[rank];
    const auto d = static_cast<std::size_t>(cells_.measures.dimension);
    for (std::size_t k = 0; k < given.size(); ++k) {
      const std::size_t i = given[k];
      cells_.measures.mass[i] = rows.mass[k];
      copy_point(&rows.centroid[k * d], d, &cells_.measures.centroid[i * d]);
      cells_.measures.second_moment[i] = rows.second_moment[k];
      cells_.measures.status[i] = rows.status[k];
      cells_.offset[i + 1] = rows.count[k];
    }
  }

  /// \pre the rows of all ranks are here
  DistributedCells cells() {
    std::partial_sum(cells_.offset.begin(), cells_.offset.end(), cells_.offset.begin());
    cells_.neighbor.resize(cells_.offset.back());
    cells_.wall.resize(cells_.offset.back());
    for (const auto& [rank, rows] : rows_) {
      if (!rows.shift.empty()) cells_.shift.resize(cells_.offset.back());
      std::size_t from = 0;
      for (std::size_t k = 0; k < rows.count.size(); ++k) {
        const std::size_t to = cells_.offset[given_[rank][k]];
        for (std::size_t w = 0; w < rows.count[k]; ++w, ++from) {
          cells_.neighbor[to + w] = rows.neighbor[from];
          cells_.wall[to + w] = rows.wall[from];
          if (!rows.shift.empty()) cells_.shift[to + w] = rows.shift[from];
        }
      }
    }
    return std::move(cells_);
  }

 private:
  const std::vector<std::vector<std::size_t>>& given_;
  DistributedCells cells_;
  std::map<std::size_t, Rows> rows_;
};

}  // namespace

Redistribution::Redistribution(const ShardSeeds& own, int dimension, int threads, Mailbox& mailbox,
                               const Period* period)
    : dimension_(dimension),
      mailbox_(mailbox),
      given_(static_cast<std::size_t>(mailbox.shards())),
      received_(given_.size()) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::vector<std::size_t> to = destinations(own, threads, period);
  for (std::size_t i = 0; i < to.size(); ++i) given_[to[i]].push_back(i);
  Mailbox::Letters letters;
  for (std::size_t rank = 0; rank < given_.size(); ++rank) {
    if (given_[rank].empty()) continue;
    std::vector<std::uint64_t> ids;
    std::vector<double> positions, weights;
    for (const std::size_t i : given_[rank]) {
      ids.push_back(own.ids[i]);
      positions.insert(positions.end(), &own.seeds.positions[i * d], &own.seeds.positions[i * d] + d);
      weights.push_back(own.seeds.weights.empty() ? 0 : own.seeds.weights[i]);
    }
    letters[static_cast<int>(rank)] = packed(ids, positions, weights);
  }
  for (const auto& [from, letter] : deliver(std::move(letters))) {
    std::vector<std::uint64_t> ids;
    std::vector<double> positions, weights;
    unpack(letter, ids, positions, weights);
    received_[static_cast<std::size_t>(from)] = ids.size();
    ids_.insert(ids_.end(), ids.begin(), ids.end());
    positions_.insert(positions_.end(), positions.begin(), positions.end());
    weights_.insert(weights_.end(), weights.begin(), weights.end());
  }
}

Mailbox::Letters Redistribution::deliver(Mailbox::Letters letters) {
  for (const auto& [to, letter] : letters)
    if (to != mailbox_.first()) bytes_ += letter.size();
  return mailbox_.deliver_one(std::move(letters));
}

std::vector<std::size_t> Redistribution::destinations(const ShardSeeds& own, int threads,
                                                      const Period* period) {
  std::span<const double> positions = own.seeds.positions;
  std::vector<double> wrapped(period == nullptr ? 0 : positions.size());
  if (period != nullptr) {
    wrap_all(*period, positions, threads, wrapped);
    positions = wrapped;
  }
  const Bounds box = bounds_of_all({dimension_, positions, {}}, mailbox_);
  const std::vector<std::uint64_t> keys = hilbert_keys(positions, dimension_, box.low, box.high, threads);
  std::vector<Place> places;
  for (std::size_t i = 0; i < keys.size(); ++i) places.emplace_back(keys[i], own.ids[i]);
  std::vector<Place> sorted = places;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<Place> last = last_places(sorted, mailbox_);
  std::vector<std::size_t> to;
  for (const Place& place : places)
    to.push_back(static_cast<std::size_t>(std::lower_bound(last.begin(), last.end(), place) - last.begin()));
  return to;
}

DistributedCells Redistribution::send_back(const DistributedCells& cells) {
  Mailbox::Letters letters;
  std::size_t begin = 0;
  for (std::size_t rank = 0; rank < received_.size(); ++rank) {
    const std::size_t end = begin + received_[rank];
    if (end == begin) continue;
    const Rows rows = rows_of(cells, begin, end);
    begin = end;
    letters[static_cast<int>(rank)] = packed(rows.mass, rows.centroid, rows.second_moment, rows.wall,
                                             rows.status, rows.count, rows.neighbor, rows.shift);
  }
  Gather gather(given_, dimension_);
  for (const auto& [rank, letter] : deliver(std::move(letters)))
    gather.take(static_cast<std::size_t>(rank), letter);
  DistributedCells own = gather.cells();
  own.measures.domain_measure = cells.measures.domain_measure;
  return own;
}

}  // namespace powercell::exchange
