#include <doctest/doctest.h>

#include <cmath>
#include <powercell/diagram.hpp>
#include <string>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::string refusal(Diagram& diagram, const SeedsView& seeds) {
  try {
    diagram.set_seeds(seeds);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_seed);
    return error.what();
  }
  return {};
}

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

// With infinite squares, the kernel's loop over near seeds once did not end.
TEST_CASE("seeds with infinite squares are refused, other far ones are not") {
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    if (precision == Precision::float64 && !test_device().info().fp64) continue;
    Options options;
    options.precision = precision;
    Diagram diagram(test_device(), unit_box(2), options);
    const bool wide = precision == Precision::float64;
    const std::vector<double> zero = {0, 0, 0}, heavy = {0, wide ? 1e290 : 1e35, 0};
    std::vector<double> positions = {0.3, 0.3, 0.6, 0.7, wide ? 1e130 : 1e16, 0.5};
    CHECK(refusal(diagram, {2, positions, zero}) == "");
    CHECK(std::abs(diagram.measures().total() - 1) <= 1e-6);
    CHECK(diagram.measures().status[2] == SeedStatus::hidden);
    CHECK(has(refusal(diagram, {2, positions, heavy}), "seed 1: weight"));
    positions[4] = wide ? 1e160 : 1e19;
    CHECK(has(refusal(diagram, {2, positions, zero}), "seed 2: coordinate x"));
    // The diagram keeps its seeds.
    CHECK(diagram.size() == 3);
    CHECK(std::abs(diagram.measures().total() - 1) <= 1e-6);
    CHECK_THROWS_AS(diagram.set_weights(heavy), Error);
  }
}
