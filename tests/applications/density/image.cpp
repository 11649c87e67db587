// Images: exact integrals, compared with diagrams of the same seeds in each pixel.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/applications/density/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct Picture {
  std::size_t width, height;
  std::vector<double> values;
  std::array<double, 2> low, high;
  ImageView view() const { return {width, height, values, low, high}; }
};

Picture random_picture(Random& random, std::array<double, 2> low, std::array<double, 2> high) {
  Picture picture{11, 7, {}, low, high};
  for (std::size_t k = 0; k < picture.width * picture.height; ++k)
    picture.values.push_back(random.uniform() < 0.2 ? 0 : random.uniform(0, 255));
  return picture;
}

Domain pixel(const Picture& picture, std::size_t column, std::size_t row) {
  const double w = (picture.high[0] - picture.low[0]) / static_cast<double>(picture.width);
  const double h = (picture.high[1] - picture.low[1]) / static_cast<double>(picture.height);
  const double x = picture.low[0] + w * static_cast<double>(column);
  const double y = picture.high[1] - h * static_cast<double>(row + 1);
  const double low[] = {x, y}, high[] = {x + w, y + h};
  return Domain::box(low, high);
}

}  // namespace

TEST_CASE("the integrals of an image are sums over its pixels, and the walls are derivatives") {
  INFO(replay_hint());
  Random random(test_seed());
  const std::array<double, 2> low{-1, 3}, high{2, 5};
  const Picture picture = random_picture(random, low, high);
  DensityCase one{"picture", Domain::box(low, high), {}};
  one.seeds = seeds_for(one.domain, Distribution::white, WeightRange::W1, 40, random);
  const std::size_t n = one.seeds.size();

  std::vector<double> mass(n, 0.0), first(2 * n, 0.0), second(n, 0.0);
  for (std::size_t k = 0; k < picture.values.size(); ++k) {
    DensityCase part{"pixel", pixel(picture, k % picture.width, k / picture.width), one.seeds};
    Diagram diagram = diagram_of(part);
    const Measures& found = diagram.measures();
    for (std::size_t i = 0; i < n; ++i) {
      if (found.mass[i] == 0) continue;
      mass[i] += picture.values[k] * found.mass[i];
      second[i] += picture.values[k] * found.second_moment[i];
      for (std::size_t c = 0; c < 2; ++c)
        first[2 * i + c] += picture.values[k] * found.mass[i] * found.centroid[2 * i + c];
    }
  }
  Diagram diagram = diagram_of(one);
  const Density density = Density::image(picture.view());
  CHECK(density.is_exact());
  const DensityIntegrals found = integrate(diagram, density, true);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += mass[i];
    CHECK(found.mass[i] == doctest::Approx(mass[i]).epsilon(1e-11));
    CHECK(found.second_moment[i] == doctest::Approx(second[i]).epsilon(1e-10));
    if (mass[i] == 0) continue;
    for (std::size_t c = 0; c < 2; ++c)
      CHECK(found.centroid[2 * i + c] == doctest::Approx(first[2 * i + c] / mass[i]).epsilon(1e-10));
  }
  CHECK(found.domain_mass == doctest::Approx(sum).epsilon(1e-12));
  CHECK(found.relative_error() < 1e-13);
  CHECK(found.walls.neighbor.size() > n);
  check_walls_are_derivatives(one, density, 128);
}

TEST_CASE("an image is 0 outside its rectangle, also in polygons with holes") {
  INFO(replay_hint());
  Random random(test_seed());
  const Domain domain = Domain::polygon(square_with_holes());
  const auto low3 = domain.low(), high3 = domain.high();
  const double middle = (low3[0] + high3[0]) / 2;
  const std::vector<double> gray{2.0};
  const ImageView left{1, 1, gray, {low3[0] - 1, low3[1] - 1}, {middle, high3[1] + 1}};
  const Density density = Density::image(left);
  DensityCase one{"holes", domain, seeds_for(domain, Distribution::white, WeightRange::W1, 60, random)};
  Diagram diagram = diagram_of(one);
  const DensityIntegrals found = integrate(diagram, density, false);
  const Density formula =
      Density::function([&](const std::array<double, 3>& x) { return x[0] < middle ? 2.0 : 0.0; });
  const DensityIntegrals expected = integrate(diagram, formula, false);
  CHECK(found.relative_error() < 1e-12);
  for (std::size_t i = 0; i < found.mass.size(); ++i)
    CHECK(std::abs(found.mass[i] - expected.mass[i]) < 1e-4 * domain.measure());
}

TEST_CASE("an image far smaller than the domain is integrated; one too small for rounding is refused") {
  INFO(replay_hint());
  Random random(test_seed());
  const DensityCase one{"square", unit_box(2),
                        random_seeds(Distribution::white, WeightRange::W1, 50, 2, random)};
  Diagram diagram = diagram_of(one);
  for (const double side : {1e-3, 1e-6, 1e-9}) {
    const std::vector<double> gray{1.0, 3.0, 0.0, 4.0};
    const ImageView image{2, 2, gray, {0.3, 0.6}, {0.3 + side, 0.6 + side}};
    const double mass = 2 * (image.high[0] - image.low[0]) * (image.high[1] - image.low[1]);
    const DensityIntegrals found = integrate(diagram, Density::image(image), true);
    CHECK(found.domain_mass == doctest::Approx(mass).epsilon(1e-4 * 1e-9 / side + 1e-9));
    CHECK(found.relative_error() < 1e-4);
  }
  const std::vector<double> gray{1.0};
  CHECK_THROWS_AS((void)Density::image({1, 1, gray, {0, 0}, {1e-15, 1e-15}}).total(one.domain), Error);
}

TEST_CASE("walls on pixel borders: a grid of seeds aligned with the image") {
  // Each cell is one pixel, and every wall lies on the border of pixels.
  const DensityCase one{"grid", unit_box(2), grid(4, 2)};
  std::vector<double> gray;
  for (int k = 0; k < 16; ++k) gray.push_back(k);
  const std::size_t side = 4;
  Diagram diagram = diagram_of(one);
  const DensityIntegrals found = integrate(diagram, Density::image({side, side, gray}), true);
  for (std::size_t i = 0; i < 16; ++i) {
    const auto column = static_cast<std::size_t>(one.seeds.coordinate(i, 0) * 4);
    const auto row = 3 - static_cast<std::size_t>(one.seeds.coordinate(i, 1) * 4);
    CHECK(found.mass[i] == doctest::Approx(gray[row * side + column] / 16));
  }
  CHECK(found.mass.size() == 16);
}
