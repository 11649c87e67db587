#include "tests/support/generators.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>

namespace powercell::test {

std::uint64_t Random::next() {
  state_ += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double Random::uniform() {
  return static_cast<double>(next() >> 11) * 0x1.0p-53;
}

double Random::uniform(double low, double high) {
  return low + (high - low) * uniform();
}

double Random::normal() {
  // A sum of twelve uniform numbers, since library functions may differ between machines in their last bits.
  double sum = -6;
  for (int k = 0; k < 12; ++k) sum += uniform();
  return sum;
}

std::size_t Random::index(std::size_t count) {
  return static_cast<std::size_t>(next() % static_cast<std::uint64_t>(count));
}

std::uint64_t test_seed() {
  const char* text = std::getenv("POWERCELL_TEST_SEED");
  return text && *text ? std::strtoull(text, nullptr, 0) : 1;
}

bool all_inputs() {
  return std::getenv("POWERCELL_TEST_ALL") != nullptr;
}

std::string replay_hint() {
  return "replay with POWERCELL_TEST_SEED=" + std::to_string(test_seed());
}

void SeedArray::push(std::initializer_list<double> position, double weight) {
  positions.insert(positions.end(), position);
  weights.push_back(weight);
}

std::string name(Distribution distribution) {
  switch (distribution) {
    case Distribution::white:
      return "white";
    case Distribution::blue:
      return "blue";
    case Distribution::cluster:
      return "cluster";
  }
  return "?";
}

std::string name(WeightRange range) {
  switch (range) {
    case WeightRange::W0:
      return "W0";
    case WeightRange::W1:
      return "W1";
    case WeightRange::W2:
      return "W2";
  }
  return "?";
}

namespace {

SeedArray empty_seeds(std::size_t n, int dimension) {
  SeedArray seeds;
  seeds.dimension = dimension;
  seeds.positions.resize(n * static_cast<std::size_t>(dimension));
  seeds.weights.assign(n, 0.0);
  return seeds;
}

double middle(const Box& box, int k) {
  return 0.5 * (box.low[static_cast<std::size_t>(k)] + box.high[static_cast<std::size_t>(k)]);
}

double edge(const Box& box, int k) {
  return box.high[static_cast<std::size_t>(k)] - box.low[static_cast<std::size_t>(k)];
}

void place(SeedArray& seeds, std::size_t i, int k, const Box& box, double unit) {
  seeds.coordinate(i, k) = box.low[static_cast<std::size_t>(k)] + edge(box, k) * unit;
}

void scatter_white(SeedArray& seeds, std::size_t first, const Box& box, Random& random) {
  for (std::size_t i = first; i < seeds.size(); ++i)
    for (int k = 0; k < seeds.dimension; ++k) place(seeds, i, k, box, random.uniform());
}

void scatter_blue(SeedArray& seeds, const Box& box, Random& random) {
  const int d = seeds.dimension;
  std::size_t per_axis = 1;
  auto count = [&] { return d == 2 ? per_axis * per_axis : per_axis * per_axis * per_axis; };
  while (count() < seeds.size()) ++per_axis;
  std::vector<std::size_t> cells(count());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    std::swap(cells[i], cells[i + random.index(cells.size() - i)]);
    std::size_t cell = cells[i];
    for (int k = 0; k < d; ++k, cell /= per_axis)
      place(
          seeds, i, k, box,
          (static_cast<double>(cell % per_axis) + random.uniform(0.2, 0.8)) / static_cast<double>(per_axis));
  }
}

void scatter_clusters(SeedArray& seeds, const Box& box, Random& random) {
  constexpr std::size_t blobs = 6;
  double center[blobs][3], width[blobs];
  for (std::size_t b = 0; b < blobs; ++b) {
    for (double& c : center[b]) c = random.uniform(0.1, 0.9);
    width[b] = random.uniform(0.01, 0.05);
  }
  const std::size_t inside = seeds.size() * 4 / 5;
  for (std::size_t i = 0; i < inside; ++i) {
    const std::size_t b = random.index(blobs);
    for (int k = 0; k < seeds.dimension; ++k) {
      // Redraws positions outside the box; clamping would put many seeds on its faces.
      double unit = center[b][k] + width[b] * random.normal();
      while (unit < 0 || unit > 1) unit = center[b][k] + width[b] * random.normal();
      place(seeds, i, k, box, unit);
    }
  }
  scatter_white(seeds, inside, box, random);
}

}  // namespace

SeedArray scatter(Distribution distribution, std::size_t n, int dimension, const Box& box, Random& random) {
  SeedArray seeds = empty_seeds(n, dimension);
  if (distribution == Distribution::white) scatter_white(seeds, 0, box, random);
  if (distribution == Distribution::blue) scatter_blue(seeds, box, random);
  if (distribution == Distribution::cluster) scatter_clusters(seeds, box, random);
  return seeds;
}

double spacing(double measure, std::size_t n, int cell_dimension) {
  return std::pow(measure / static_cast<double>(n), 1.0 / cell_dimension);
}

void set_weights(SeedArray& seeds, WeightRange range, double h, Random& random) {
  const double largest = range == WeightRange::W0 ? 0 : range == WeightRange::W1 ? 0.5 * h * h : 4 * h * h;
  for (double& w : seeds.weights) w = largest * random.uniform();
}

SeedArray random_seeds(Distribution distribution, WeightRange range, std::size_t n, int dimension,
                       Random& random, const Box& box) {
  SeedArray seeds = scatter(distribution, n, dimension, box, random);
  double measure = 1;
  for (int k = 0; k < dimension; ++k) measure *= edge(box, k);
  if (n > 0) set_weights(seeds, range, spacing(measure, n, dimension), random);
  return seeds;
}

SeedArray grid(int per_axis, int dimension, const Box& box) {
  const auto m = static_cast<std::size_t>(per_axis);
  SeedArray seeds = empty_seeds(dimension == 2 ? m * m : m * m * m, dimension);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    std::size_t cell = i;
    for (int k = 0; k < dimension; ++k, cell /= m)
      place(seeds, i, k, box, (static_cast<double>(cell % m) + 0.5) / per_axis);
  }
  return seeds;
}

SeedArray collinear(std::size_t n, int dimension, const Box& box) {
  SeedArray seeds = empty_seeds(n, dimension);
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < dimension; ++k)
      place(seeds, i, k, box, (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  return seeds;
}

SeedArray coplanar(std::size_t n, Random& random, const Box& box) {
  SeedArray seeds = scatter(Distribution::white, n, 3, box, random);
  for (std::size_t i = 0; i < n; ++i) seeds.coordinate(i, 2) = middle(box, 2);
  return seeds;
}

SeedArray cospherical(std::size_t n, int dimension, const Box& box) {
  SeedArray seeds = empty_seeds(n, dimension);
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t i = 0; i < n; ++i) {
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const double z = dimension == 2 ? 0 : 1 - 2 * t;
    const double angle = dimension == 2 ? 2 * std::numbers::pi * t : golden * static_cast<double>(i);
    const double r = std::sqrt(1 - z * z);
    const double direction[3] = {r * std::cos(angle), r * std::sin(angle), z};
    for (int k = 0; k < dimension; ++k)
      seeds.coordinate(i, k) = middle(box, k) + 0.4 * edge(box, k) * direction[k];
  }
  return seeds;
}

SeedArray spread_over_scales(std::size_t n, int dimension, double decades, Random& random, const Box& box) {
  SeedArray seeds = empty_seeds(n, dimension);
  for (std::size_t i = 0; i < n; ++i) {
    const double radius = 0.45 * std::pow(10.0, -decades * random.uniform());
    for (int k = 0; k < dimension; ++k)
      seeds.coordinate(i, k) = middle(box, k) + radius * edge(box, k) * random.uniform(-1, 1);
  }
  return seeds;
}

void rotate(SeedArray& seeds, double angle, const std::array<double, 3>& center) {
  const auto turn = [&](int a, int b, double by) {
    const double c = std::cos(by), s = std::sin(by);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const double x = seeds.coordinate(i, a) - center[static_cast<std::size_t>(a)];
      const double y = seeds.coordinate(i, b) - center[static_cast<std::size_t>(b)];
      seeds.coordinate(i, a) = center[static_cast<std::size_t>(a)] + c * x - s * y;
      seeds.coordinate(i, b) = center[static_cast<std::size_t>(b)] + s * x + c * y;
    }
  };
  turn(0, 1, angle);
  if (seeds.dimension == 3) turn(1, 2, 0.5 * angle);
}

void translate(SeedArray& seeds, const std::array<double, 3>& by) {
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (int k = 0; k < seeds.dimension; ++k) seeds.coordinate(i, k) += by[static_cast<std::size_t>(k)];
}

void scale(SeedArray& seeds, double s) {
  for (double& x : seeds.positions) x *= s;
  for (double& w : seeds.weights) w *= s * s;
}

}  // namespace powercell::test
