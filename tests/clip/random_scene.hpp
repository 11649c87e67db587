/// \file
/// A scene of random seeds in the unit box, for tests of clipping.
#pragma once

#include <cmath>
#include <random>

#include "lib/base/random.hpp"
#include "lib/scene/scene.hpp"
#include "tests/support/domains.hpp"

namespace powercell::test {

/// The device chosen by the environment; lives until the process ends.
inline std::shared_ptr<cl::Context> test_context() {
  static auto* device = new Device(Device::choose());
  return device->context();
}

struct RandomScene {
  /// \param weights  of the seeds are uniform in [0, weights h^2] with h = n^(-1/d)
  RandomScene(const std::shared_ptr<cl::Context>& context, int dimension, std::size_t n, double weights,
              bool float32)
      : RandomScene(context, dimension, random_values(dimension, n, weights), float32) {}

  RandomScene(const std::shared_ptr<cl::Context>& context, int dimension,
              const std::pair<std::vector<double>, std::vector<double>>& values, bool float32)
      : domain(unit_box(dimension)),
        seeds(make_seed_set({dimension, values.first, values.second}, dimension, 1)),
        tree(build_packed_tree(seeds, 1)),
        own(context, domain.mesh(), float32, seeds, tree) {}

  static std::pair<std::vector<double>, std::vector<double>> random_values(int dimension, std::size_t n,
                                                                           double weights) {
    std::mt19937_64 generator(7);
    const double h = std::pow(static_cast<double>(n), -1.0 / dimension);
    std::vector<double> positions(n * static_cast<std::size_t>(dimension)), w(n);
    for (double& x : positions) x = uniform(generator);
    for (double& x : w) x = weights * h * h * uniform(generator);
    return {positions, w};
  }

  Domain domain;
  SeedSet seeds;
  PackedTree tree;
  OwnScene own;
  const Scene& scene = own.scene;
};

}  // namespace powercell::test
