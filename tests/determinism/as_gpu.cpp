// What only GPUs are given, chunks that the host completes while the next one is clipped, gives the same
// bits.
#include <doctest/doctest.h>

#include "tests/support/domains.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Results results(const Device& device, const Options& options, const Domain& domain, const SeedArray& seeds) {
  Diagram diagram(device, domain, options);
  diagram.set_seeds(seeds.view());
  return results_of(diagram);
}

}  // namespace

TEST_CASE("a device treated as a GPU gives the same bits, chunk by chunk") {
  const Setup& setup = main_setups().front();
  const std::string name = setup.device.info().selector();
  const Environment treated("POWERCELL_TREAT_AS", "gpu");
  const Device gpu = Device::choose(name);
  CHECK(gpu.info().type == DeviceInfo::Type::gpu);
  const Domain several = Domain::polygon(islands());
  Random random(test_seed());
  const std::vector<SeededDomain> cases = {
      // One region: the host changes moments that it has read. Rounding decides every cell.
      {{"cube", unit_box(3)}, grid(10, 3)},
      // The device sums the moments of several regions.
      {{"islands", several}, seeds_for(several, Distribution::white, WeightRange::W2, 1000, random)}};
  for (const SeededDomain& c : cases) {
    INFO(c.domain.name);
    Options options = setup.options;
    const Results expected = results(setup.device, options, c.domain.domain, c.seeds);
    for (const std::uint64_t chunk : {std::uint64_t{130}, std::uint64_t{999}}) {
      CAPTURE(chunk);
      options.chunk_pairs = chunk;
      CHECK(bit_differences(results(gpu, options, c.domain.domain, c.seeds), expected) == "");
    }
  }
}
