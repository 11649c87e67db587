#include "lib/exchange/sharded.hpp"

#include <utility>

#include "lib/diagram/state.hpp"

namespace powercell::exchange {
namespace {

/// Between shards that are all here.
class LocalMailbox : public Mailbox {
 public:
  explicit LocalMailbox(std::size_t shards) : shards_(static_cast<int>(shards)) {}

  int shards() const override { return shards_; }
  int first() const override { return 0; }
  const char* noun() const override { return "shard"; }

  std::vector<Letters> deliver(std::vector<Letters> letters) override {
    std::vector<Letters> delivered(letters.size());
    for (std::size_t s = 0; s < letters.size(); ++s)
      for (auto& [to, letter] : letters[s])
        delivered[static_cast<std::size_t>(to)][static_cast<int>(s)] = std::move(letter);
    return delivered;
  }
  std::vector<Bytes> share(std::vector<Bytes> own) override { return own; }

 private:
  int shards_;
};

}  // namespace

ShardedDiagram compute_shards(const Device& device, const Domain& domain, std::span<const ShardSeeds> shards,
                              Options options, const Estimate& estimate) {
  require_supported(domain, options);
  Diagram::State diagram(device, domain, options);
  LocalMailbox mailbox(shards.size());
  require_valid(diagram.setup, shards, mailbox);
  Steps steps(diagram, shards, mailbox, estimate);
  ShardedDiagram result;
  result.shards = steps.run();
  result.report = steps.report();
  return result;
}

}  // namespace powercell::exchange
