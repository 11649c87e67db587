// Sizes near 2^31 and beyond are refused before an element is read, or have no effect. The spans claim more
// elements than exist, so that no memory is needed.
#include <doctest/doctest.h>

#include <limits>
#include <powercell/diagram.hpp>
#include <powercell/opencl.hpp>
#include <powercell/shapes.hpp>
#include <powercell/verify.hpp>
#include <string>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The code and the message of what `action` throws.
template <class Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return std::string(name(error.code())) + ": " + error.what();
  }
  return "nothing";
}

bool mentions(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

/// A span of `size` elements of which only the first few exist.
template <class T>
std::span<const T> claimed(const std::vector<T>& some, std::size_t size) {
  return {some.data(), size};
}

const std::vector<double> kFew(12, 0.5);
const std::vector<std::uint32_t> kIndices{0, 1, 2, 3};

Diagram square_diagram(const Options& options = {}) {
  return {main_setups().front().device, unit_box(2), options};
}

}  // namespace

TEST_CASE("more seeds than a diagram can hold") {
  for (const std::size_t n :
       {(std::size_t{1} << 30) + 1, std::size_t{2147483647}, std::size_t{1} << 32, std::size_t{1} << 40}) {
    const std::string message = refusal([&] { square_diagram().set_seeds({2, claimed(kFew, 2 * n), {}}); });
    CHECK_MESSAGE(mentions(message, "invalid_argument: " + std::to_string(n) + " seeds are more than"),
                  message);
    CHECK_MESSAGE(mentions(message, "1073741824"), message);
  }
}

TEST_CASE("sizes of weights and positions that are equal only modulo 2^32") {
  const std::size_t four_more = (std::size_t{1} << 32) + 4;
  const std::string message = refusal([&] {
    square_diagram().set_seeds({2, std::span(kFew).first(8), claimed(kFew, four_more)});
  });
  CHECK_MESSAGE(mentions(message, std::to_string(four_more) + " weights for 4 seeds"), message);
  Diagram diagram = square_diagram();
  diagram.set_seeds({2, std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}, {}});
  CHECK(mentions(refusal([&] { diagram.set_weights(claimed(kFew, four_more)); }), "weights for 4 seeds"));
  CHECK(diagram.measures().relative_error() < 1e-5);  // it keeps its seeds
}

TEST_CASE("more vertices, triangles, tetrahedra and parts than indices can address") {
  const std::size_t vertices = std::size_t{1} << 31;
  std::string message =
      refusal([&] { Domain::surface(claimed(kFew, 3 * vertices), std::span(kIndices).first(3)); });
  CHECK_MESSAGE(mentions(message, "invalid_domain: 2147483648 vertices are more than"), message);
  message = refusal(
      [&] { Domain::surface(std::span(kFew).first(9), claimed(kIndices, 3 * (std::size_t{1} << 31))); });
  CHECK_MESSAGE(mentions(message, "invalid_domain: 2147483648 triangles are more than"), message);
  message = refusal([&] { Domain::volume(kFew, claimed(kIndices, std::size_t{1} << 32)); });
  CHECK_MESSAGE(mentions(message, "invalid_domain: 1073741824 tetrahedra are more than"), message);
  const Parts parts = unit_square();
  message =
      refusal([&] { Domain::polygon(std::span<const PolygonPart>(parts.data(), std::size_t{1} << 33)); });
  CHECK_MESSAGE(mentions(message, "invalid_domain: a polygon can have at most 2^30 parts"), message);
}

TEST_CASE("a box of dimension other than 2 and 3") {
  for (const std::size_t d : {std::size_t{0}, std::size_t{1}, std::size_t{4}, (std::size_t{1} << 32) + 2})
    CHECK(mentions(refusal([&] { Domain::box(claimed(kFew, d), claimed(kFew, d)); }), "invalid_domain"));
}

TEST_CASE("shapes of resolutions that do not fit") {
  for (const int n : {0, -1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    CHECK(mentions(refusal([&] { sphere(n); }), "invalid_argument"));
    CHECK(mentions(refusal([&] { torus(n); }), "invalid_argument"));
    CHECK(mentions(refusal([&] { ball(n); }), "invalid_argument"));
    if (n <= 0) CHECK(mentions(refusal([&] { disk(n); }), "invalid_argument"));
  }
}

TEST_CASE("options as large as their types") {
  const SeedArray seeds = [] {
    Random random(test_seed());
    return random_seeds(Distribution::white, WeightRange::W1, 200, 2, random);
  }();
  Diagram plain = square_diagram();
  plain.set_seeds(seeds.view());
  Options options;
  options.chunk_pairs = std::numeric_limits<std::uint64_t>::max();
  options.threads = std::numeric_limits<int>::max();
  Diagram extreme = square_diagram(options);
  extreme.set_seeds(seeds.view());
  CHECK(extreme.measures().mass == plain.measures().mass);
  CHECK(extreme.adjacency().wall == plain.adjacency().wall);
}

TEST_CASE("verify with another number of seeds than the diagram's") {
  Diagram diagram = square_diagram();
  diagram.set_seeds({2, std::span(kFew).first(2), {}});
  const std::string message = refusal([&] {
    verify(diagram, {2, claimed(kFew, 2 * (std::size_t{1} << 40)), {}});
  });
  CHECK_MESSAGE(mentions(message, "1099511627776 seeds in 2D were given"), message);
}
