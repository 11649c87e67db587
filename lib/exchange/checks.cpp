#include "lib/exchange/checks.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <optional>
#include <powercell/error.hpp>
#include <powercell/version.hpp>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "lib/base/mailbox.hpp"
#include "lib/base/random.hpp"
#include "lib/diagram/given_seeds.hpp"
#include "lib/domain/region_mesh.hpp"

namespace powercell::exchange {

namespace {

/// The first fault of a shard's seeds in ascending order of their ids, with the id.
/// \pre there is one
InputFault first_by_id(const DiagramSetup& setup, const ShardSeeds& shard) {
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

void require_sizes(const DiagramSetup& setup, const ShardSeeds& shard) {
  if (shard.ids.size() != shard.seeds.size())
    throw Error(ErrorCode::invalid_argument, std::to_string(shard.ids.size()) + " ids for " +
                                                 std::to_string(shard.seeds.size()) + " seeds");
  check_sizes(shard.seeds, setup.domain.dimension());
}

/// An id that is there twice, and the shards that have it.
using Twice = std::array<std::uint64_t, 3>;

/// The lowest id that occurs twice among letters.
/// \return empty if none does
std::vector<Twice> lowest_twice(const Mailbox::Letters& letters) {
  std::vector<std::pair<std::uint64_t, int>> ids;
  std::vector<std::uint64_t> of_shard;
  for (const auto& [from, letter] : letters) {
    unpack(letter, of_shard);
    if (!std::is_sorted(of_shard.begin(), of_shard.end())) std::sort(of_shard.begin(), of_shard.end());
    const auto before = static_cast<std::ptrdiff_t>(ids.size());
    for (const std::uint64_t id : of_shard) ids.emplace_back(id, from);
    std::inplace_merge(ids.begin(), ids.begin() + before, ids.end());
  }
  const auto twice = std::adjacent_find(ids.begin(), ids.end(),
                                        [](const auto& a, const auto& b) { return a.first == b.first; });
  if (twice == ids.end()) return {};
  const auto shard = [](const auto& entry) { return static_cast<std::uint64_t>(entry.second); };
  return {{twice->first, shard(*twice), shard(*(twice + 1))}};
}

/// Equal ids go to the same shard.
void require_once(std::span<const ShardSeeds> here, Mailbox& mailbox) {
  std::vector<Mailbox::Letters> letters(here.size());
  for (std::size_t s = 0; s < here.size(); ++s) {
    std::vector<std::vector<std::uint64_t>> to(static_cast<std::size_t>(mailbox.shards()));
    for (const std::uint64_t id : here[s].ids)
      to[static_cast<std::size_t>(meeting_shard(id, mailbox.shards()))].push_back(id);
    for (std::size_t t = 0; t < to.size(); ++t)
      if (!to[t].empty()) letters[s][static_cast<int>(t)] = packed(to[t]);
  }
  std::vector<Bytes> found;
  for (const Mailbox::Letters& to_shard : mailbox.deliver(std::move(letters)))
    found.push_back(packed(lowest_twice(to_shard)));
  std::optional<Twice> first;
  std::vector<Twice> twice;
  for (const Bytes& of_shard : mailbox.share(std::move(found))) {
    unpack(of_shard, twice);
    if (!twice.empty() && (!first || twice[0] < *first)) first = twice[0];
  }
  if (!first) return;
  const auto [id, a, b] = *first;
  const std::string noun = mailbox.noun(),
                    where = a == b ? "both of " + noun + " " + std::to_string(a)
                                   : "of " + noun + "s " + std::to_string(a) + " and " + std::to_string(b);
  throw Error(ErrorCode::invalid_argument, "two seeds have the id " + std::to_string(id) + ", " + where +
                                               "; give each seed of all " + noun + "s an id of its own");
}

/// Refuses the seed that a diagram of all seeds would refuse first.
void require_no_fault(const DiagramSetup& setup, std::span<const ShardSeeds> here, Mailbox& mailbox) {
  std::vector<Bytes> found;
  for (const ShardSeeds& shard : here) {
    std::vector<std::uint64_t> key;
    std::vector<char> why;
    if (first_fault(setup, shard.seeds)) {
      const InputFault fault = first_by_id(setup, shard);
      key = {static_cast<std::uint64_t>(fault.order), fault.fault.seed};
      why.assign(fault.fault.why.begin(), fault.fault.why.end());
    }
    found.push_back(packed(key, why));
  }
  std::vector<std::uint64_t> least, key;
  std::vector<char> reason, why;
  for (const Bytes& of_shard : mailbox.share(std::move(found))) {
    unpack(of_shard, key, why);
    if (key.empty() || (!least.empty() && !(key < least))) continue;
    std::tie(least, reason) = std::pair(key, why);
  }
  if (!least.empty()) refuse_seed(least[1], {reason.begin(), reason.end()});
}

}  // namespace

int meeting_shard(std::uint64_t id, int shards) {
  return static_cast<int>(mixed_bits(id) % static_cast<std::uint64_t>(shards));
}

void require_supported(const Domain& domain, const Options& options, const std::string& what) {
  if (domain.kind() == DomainKind::surface || domain.is_solid())
    throw Error(ErrorCode::unsupported, what +
                                            " need a polygon, a box or a volume of tetrahedra as domain, "
                                            "neither a surface nor a solid");
  if (options.decisions != Decisions::exact)
    throw Error(ErrorCode::unsupported,
                what + " need exact decisions, which do not depend on where seeds are");
  if (options.certify)
    throw Error(ErrorCode::unsupported,
                "the laws that Options::certify checks are those of one diagram; turn it off for " + what);
}

void require_valid(const DiagramSetup& setup, std::span<const ShardSeeds> here, Mailbox& mailbox) {
  if (setup.float32()) throw Error(ErrorCode::unsupported, "distributed seeds need double precision");
  for (const ShardSeeds& shard : here) require_sizes(setup, shard);
  require_once(here, mailbox);
  require_no_fault(setup, here, mailbox);
}

namespace {

class Digest {
 public:
  Digest& add(std::integral auto number) {
    value_ = mixed_bits(value_ ^ static_cast<std::uint64_t>(number));
    return *this;
  }
  Digest& add(double value) { return add(std::bit_cast<std::uint64_t>(value)); }
  Digest& add(const Border& border) {
    return add(std::uint64_t{static_cast<std::uint32_t>(border.kind)} << 32 | border.index);
  }
  template <class Values>
  Digest& add_all(const Values& values) {
    for (const auto& value : values) add(value);
    return add(values.size());
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace

std::vector<NamedValue> call_values(const Domain& domain, const Options& options) {
  const RegionMesh& mesh = domain.mesh();
  const auto number = [](auto value) { return static_cast<std::uint64_t>(value); };  // of an enumeration
  Digest periods;
  if (mesh.period)
    for (int axis = 0; axis < mesh.dimension; ++axis)
      periods.add(mesh.period->is_periodic(axis)).add_all(mesh.period->given(axis));
  return {{"the version of powercell", Digest().add_all(std::string_view(version())).value()},
          {"the kind of domain", Digest()
                                     .add(number(mesh.kind))
                                     .add(mesh.dimension)
                                     .add(domain.is_solid())
                                     .add(domain.is_periodic())
                                     .value()},
          {"the vertices of the domain",
           Digest().add_all(mesh.vertices).add_all(mesh.low).add_all(mesh.high).add(mesh.measure).value()},
          {"the regions of the domain",
           Digest().add_all(mesh.region_offset).add_all(mesh.region_vertex).add_all(mesh.facet).value()},
          {"the periods of the domain", periods.value()},
          {"Options::precision", number(options.precision)},
          {"Options::decisions", number(options.decisions)},
          {"Options::certify", number(options.certify)}};
}

void require_same_call(const Domain& domain, const DistributedOptions& options, Mailbox& mailbox) {
  std::vector<NamedValue> values = call_values(domain, options.diagram);
  values.push_back({"DistributedOptions::redistribute", static_cast<std::uint64_t>(options.redistribute)});
  require_same(values, mailbox);
}

}  // namespace powercell::exchange
