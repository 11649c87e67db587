// Diagrams from a kept mesh are those computed anew.
#include <doctest/doctest.h>

#include <cstdlib>

#include "tests/support/generators.hpp"
#include "tests/update/loops.hpp"

using namespace powercell::test;

namespace {

LoopTally run_loops(std::size_t loops, std::size_t most_seeds) {
  LoopTally tally;
  for (std::size_t k = 0; k < loops; ++k) run_loop(test_seed() + k, most_seeds, tally);
  MESSAGE(tally.updates << " updates, " << tally.from_mesh << " from the mesh, " << tally.reused << " of "
                        << tally.cells << " cells reused; largest difference of a measure "
                        << tally.worst_measure << " of the mean, of a wall " << tally.worst_wall);
  return tally;
}

}  // namespace

TEST_CASE("diagrams of random loops are those computed anew") {
  INFO(replay_hint());
  const LoopTally tally = run_loops(60, 2000);
  INFO(tally.differences);
  CHECK(tally.different == 0);
  CHECK(2 * tally.from_mesh > tally.updates);
  CHECK(3 * tally.reused > tally.cells);
}

/// POWERCELL_TEST_LOOPS is the number of loops, of eight updates each.
TEST_CASE("campaign: diagrams of many random loops are those computed anew" * doctest::skip()) {
  INFO(replay_hint());
  const char* const given = std::getenv("POWERCELL_TEST_LOOPS");
  const LoopTally tally = run_loops(given ? static_cast<std::size_t>(std::atoll(given)) : 12500, 5000);
  INFO(tally.differences);
  CHECK(tally.different == 0);
}
