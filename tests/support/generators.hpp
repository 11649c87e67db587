/// \file
/// Seeds for tests and benchmarks: random families with the weights of the paper, and the degenerate
/// families that a power diagram must survive. Everything is a function of the random seed, bit for bit
/// on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/seeds.hpp>
#include <string>
#include <vector>

namespace powercell::test {

/// splitmix64: small, portable, good enough for points.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  double uniform();  ///< in [0, 1)
  double uniform(double low, double high);
  double normal();                       ///< mean 0, variance 1
  std::size_t index(std::size_t count);  ///< in [0, count)

 private:
  std::uint64_t state_;
};

/// The random seed of this run: POWERCELL_TEST_SEED if set, else 1.
std::uint64_t test_seed();
/// What to type to run a failed case again; meant for doctest's INFO.
std::string replay_hint();

/// Owned seeds; `view()` is what the library takes.
struct SeedArray {
  int dimension = 3;
  std::vector<double> positions;  ///< n x dimension, row-major
  std::vector<double> weights;    ///< n

  std::size_t size() const { return positions.size() / static_cast<std::size_t>(dimension); }
  SeedsView view() const { return {dimension, positions, weights}; }
  double coordinate(std::size_t i, int k) const {
    return positions[i * static_cast<std::size_t>(dimension) + static_cast<std::size_t>(k)];
  }
  double& coordinate(std::size_t i, int k) {
    return positions[i * static_cast<std::size_t>(dimension) + static_cast<std::size_t>(k)];
  }
  void push(std::initializer_list<double> position, double weight);
};

/// An axis-aligned box, third coordinate unused in 2D.
struct Box {
  std::array<double, 3> low{0, 0, 0};
  std::array<double, 3> high{1, 1, 1};
};

enum class Distribution { white, blue, cluster };
enum class WeightRange { W0, W1, W2 };  ///< zero; uniform in [0, h^2/2]; uniform in [0, 4 h^2]
std::string name(Distribution distribution);
std::string name(WeightRange range);

/// n positions in a box, weights zero. white: uniform; blue: a jittered grid; cluster: 80 % in six
/// Gaussian blobs (draws outside the box are drawn again), the rest white.
SeedArray scatter(Distribution distribution, std::size_t n, int dimension, const Box& box, Random& random);

/// The spacing h of n seeds in a cell space of that measure and dimension: (measure / n)^(1/d).
double spacing(double measure, std::size_t n, int cell_dimension);
/// Replaces the weights by random ones of the range for the spacing h.
void set_weights(SeedArray& seeds, WeightRange range, double h, Random& random);
/// scatter and set_weights with h = n^(-1/d) times the edge of the box.
SeedArray random_seeds(Distribution distribution, WeightRange range, std::size_t n, int dimension,
                       Random& random, const Box& box = {});

/// Degenerate families, weights zero.
SeedArray grid(int per_axis, int dimension, const Box& box = {});          ///< centres of a regular grid
SeedArray collinear(std::size_t n, int dimension, const Box& box = {});    ///< on the box's diagonal
SeedArray coplanar(std::size_t n, Random& random, const Box& box = {});    ///< on the plane z = middle
SeedArray cospherical(std::size_t n, int dimension, const Box& box = {});  ///< on a circle or sphere
/// Seeds whose distances to the middle span the `decades` orders of magnitude below the box's edge.
SeedArray spread_over_scales(std::size_t n, int dimension, double decades, Random& random,
                             const Box& box = {});

/// Turns positions about `center`: by `angle` in the plane, in space also by half of it about x.
void rotate(SeedArray& seeds, double angle, const std::array<double, 3>& center);
void translate(SeedArray& seeds, const std::array<double, 3>& by);
/// Positions times s, weights times s^2.
void scale(SeedArray& seeds, double s);

}  // namespace powercell::test
