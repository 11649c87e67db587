#include "lib/exchange/sharded.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <powercell/error.hpp>
#include <string>
#include <utility>

#include "lib/diagram/state.hpp"

namespace powercell::exchange {
namespace {

/// Nodes of an outline's lowest level.
constexpr std::size_t outline_nodes = 512;

void require_supported(const Domain& domain, const Options& options) {
  if (domain.kind() == DomainKind::surface || domain.is_solid() || domain.is_periodic())
    throw Error(
        ErrorCode::unsupported,
        "seeds in shards need a polygon, a box or a volume of tetrahedra as domain, neither a surface nor a "
        "solid nor a periodic domain");
  if (options.decisions != Decisions::exact)
    throw Error(ErrorCode::unsupported,
                "seeds in shards need exact decisions, which do not depend on the shards");
  if (options.certify)
    throw Error(
        ErrorCode::unsupported,
        "the laws that Options::certify checks are those of one diagram; turn it off for seeds in shards");
}

/// The first fault of a shard's seeds in ascending order of their ids, with the id. \pre there is one
InputFault first_by_id(const Setup& setup, const ShardSeeds& shard) {
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t k = 0; k < shard.ids.size(); ++k) order.emplace_back(shard.ids[k], k);
  std::sort(order.begin(), order.end());
  const auto d = static_cast<std::size_t>(shard.seeds.dimension);
  std::vector<double> positions, weights;
  for (const auto& [id, k] : order) {
    positions.insert(positions.end(), &shard.seeds.positions[k * d], &shard.seeds.positions[k * d] + d);
    if (!shard.seeds.weights.empty()) weights.push_back(shard.seeds.weights[k]);
  }
  InputFault found = first_fault(setup, {shard.seeds.dimension, positions, weights}).value();
  found.fault.seed = order[found.fault.seed].first;
  return found;
}

class Exchange {
 public:
  Exchange(const Device& device, const Domain& domain, std::span<const ShardSeeds> shards,
           const Options& options)
      : diagram_(device, domain, options) {
    if (diagram_.setup.float32())
      throw Error(ErrorCode::unsupported, "seeds in shards need double precision");
    require_valid(shards);
    for (const ShardSeeds& seeds : shards)
      shards_.emplace_back(static_cast<int>(shards_.size()), seeds.ids, seeds.seeds, domain.dimension(),
                           options.threads);
    const auto outlines = std::make_shared<std::vector<PackedTree>>();
    for (const Shard& shard : shards_) {
      outlines->push_back(outline_of(shard.own().tree(), outline_nodes));
      report_.outlines += outline_bytes(outlines->back()) * (shards_.size() - 1);
    }
    for (Shard& shard : shards_) shard.meet(outlines);
  }

  ShardedDiagram run() {
    const auto any_open = [this] {
      return std::any_of(shards_.begin(), shards_.end(), [](const Shard& s) { return s.open_cells() > 0; });
    };
    while (any_open()) {
      while (any_open()) round();
      end_hidden();
    }
    mark_duplicates();
    ShardedDiagram result;
    for (const Shard& shard : shards_) {
      result.shards.push_back(shard.cells(diagram_.setup.domain.measure()));
      report_.clipped += shard.clipped_cells();
      report_.fetched += shard.foreign_seeds();
      report_.neighbors += shard.foreign_neighbors();
    }
    result.report = report_;
    return result;
  }

 private:
  void require_valid(std::span<const ShardSeeds> shards) const;

  void round() {
    ++report_.rounds;
    std::vector<std::map<int, Request>> requests;
    for (Shard& shard : shards_) requests.push_back(shard.clip(diagram_));
    for (std::size_t s = 0; s < shards_.size(); ++s) {
      for (const auto& [to, request] : requests[s]) {
        const Reply reply = shards_[static_cast<std::size_t>(to)].own().answer(static_cast<int>(s), request);
        report_.vertices += reply.found.size();
        report_.requests += request.bytes();
        report_.replies += reply.bytes();
        shards_[s].take(to, reply);
      }
      shards_[s].settle();
    }
  }

  /// Tells shards which seeds that they were sent are hidden. Cells with a wall of one are opened again.
  void end_hidden() {
    for (std::size_t to = 0; to < shards_.size(); ++to) {
      for (std::size_t from = 0; from < shards_.size(); ++from) {
        if (from == to) continue;
        const std::vector<std::uint64_t> hidden = shards_[from].own().take_hidden(static_cast<int>(to));
        report_.ending += bytes_of(hidden);
        shards_[to].forget(hidden);
      }
      shards_[to].reopen();
    }
  }

  void mark_duplicates() {
    for (Shard& shard : shards_)
      for (const auto& [to, twins] : shard.twins()) {
        const std::vector<std::uint8_t> better =
            shards_[static_cast<std::size_t>(to)].own().better_twins(twins);
        report_.ending += twins.bytes() + bytes_of(better);
        shard.mark_duplicates(twins, better);
      }
  }

  Diagram::State diagram_;
  std::vector<Shard> shards_;
  ExchangeReport report_;
};

void Exchange::require_valid(std::span<const ShardSeeds> shards) const {
  std::vector<std::uint64_t> ids;
  std::optional<InputFault> first;
  for (const ShardSeeds& shard : shards) {
    if (shard.ids.size() != shard.seeds.size())
      throw Error(ErrorCode::invalid_argument, std::to_string(shard.ids.size()) + " ids for " +
                                                   std::to_string(shard.seeds.size()) + " seeds of a shard");
    ids.insert(ids.end(), shard.ids.begin(), shard.ids.end());
  }
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end())
    throw Error(ErrorCode::invalid_argument, "two seeds have the id " + std::to_string(*twice) +
                                                 "; give each seed of all shards an id of its own");
  for (const ShardSeeds& shard : shards) {
    check_sizes(shard.seeds, diagram_.setup.domain.dimension());
    std::optional<InputFault> found = first_fault(diagram_.setup, shard.seeds);
    if (!found) continue;
    found = first_by_id(diagram_.setup, shard);
    if (!first || std::pair(found->order, found->fault.seed) < std::pair(first->order, first->fault.seed))
      first = std::move(found);
  }
  if (first) refuse_seed(first->fault.seed, first->fault.why);
}

}  // namespace

ShardedDiagram compute_shards(const Device& device, const Domain& domain, std::span<const ShardSeeds> shards,
                              Options options) {
  require_supported(domain, options);
  options.keep_mesh = false;  // for all seeds alone
  return Exchange(device, domain, shards, options).run();
}

}  // namespace powercell::exchange
