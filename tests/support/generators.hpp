/// \file
/// Seeds for tests and benchmarks: random families with the weights of the paper, and degenerate families. A
/// random seed gives the same bits on every machine.
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
/// Whether tests take all of their inputs: POWERCELL_TEST_ALL is set. Else those that are many, or need
/// kernels that take long to compile, take some (tests/README.md, "Time").
bool all_inputs();
/// The number of inputs of a test: `all`, or `some` of them.
template <class Number>
Number number_of_inputs(Number some, Number all) {
  return all_inputs() ? all : some;
}
/// How to run a failed case again, for doctest's INFO.
std::string replay_hint();

/// Seeds with their memory; view() is for the library.
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

/// n positions in a box, with weights 0. white: uniform; blue: a jittered grid; cluster: 80 % in six Gaussian
/// blobs (redrawn if outside the box), the rest white.
SeedArray scatter(Distribution distribution, std::size_t n, int dimension, const Box& box, Random& random);

/// The spacing h = (measure / n)^(1/d) of n seeds.
double spacing(double measure, std::size_t n, int cell_dimension);
/// Replaces the weights by random ones of the range for the spacing h.
void set_weights(SeedArray& seeds, WeightRange range, double h, Random& random);
/// scatter() and set_weights() with h = n^(-1/d) times the edge of the box.
SeedArray random_seeds(Distribution distribution, WeightRange range, std::size_t n, int dimension,
                       Random& random, const Box& box = {});

/// Degenerate families, with weights 0.
SeedArray grid(int per_axis, int dimension, const Box& box = {});          ///< centres of a regular grid
SeedArray collinear(std::size_t n, int dimension, const Box& box = {});    ///< on the box's diagonal
SeedArray coplanar(std::size_t n, Random& random, const Box& box = {});    ///< on the plane z = middle
SeedArray cospherical(std::size_t n, int dimension, const Box& box = {});  ///< on a circle or sphere
/// Seeds with distances to the middle over `decades` orders of magnitude below the box's edge.
SeedArray spread_over_scales(std::size_t n, int dimension, double decades, Random& random,
                             const Box& box = {});

/// Rotates positions about `center`: by `angle` in the xy plane, in space then by half of it about x.
void rotate(SeedArray& seeds, double angle, const std::array<double, 3>& center);
void translate(SeedArray& seeds, const std::array<double, 3>& by);
/// Positions times s, weights times s^2.
void scale(SeedArray& seeds, double s);

}  // namespace powercell::test
