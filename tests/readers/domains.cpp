// Domains from the argument of --domain, and random seeds in them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/io/read/domain.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

TEST_CASE("built-in shapes") {
  const double pi = std::numbers::pi;
  CHECK(read_domain("square").domain.measure() == 1);
  CHECK(read_domain("cube").domain.measure() == 1);
  CHECK(read_domain("cube").elements.size() == 6 * 4);
  CHECK(read_domain("disk").domain.measure() == doctest::Approx(pi).epsilon(0.01));
  CHECK(read_domain("sphere").domain.measure() == doctest::Approx(4 * pi).epsilon(0.02));
  CHECK(read_domain("ball").domain.measure() == doctest::Approx(4 * pi / 3).epsilon(0.05));
  CHECK(read_domain("torus").domain.kind() == DomainKind::surface);
  CHECK(read_domain("sphere:3").elements.size() < read_domain("sphere:20").elements.size());
  const LoadedDomain slab = read_domain("box:-1,0,2:3,1,2.5", {}, "xy");
  CHECK(slab.domain.measure() == 2);
  CHECK(slab.domain.periods()[0] == std::array<double, 3>{4, 0, 0});
  CHECK(slab.domain.periods()[2] == std::array<double, 3>{0, 0, 0});
  CHECK(Domain::volume(slab.vertices, slab.elements).measure() == doctest::Approx(2));
  const LoadedDomain skew = read_domain("lattice:1,0/0.5,0.8");
  CHECK(skew.domain.is_periodic());
  CHECK(skew.domain.measure() == doctest::Approx(0.8));
  CHECK(Domain::polygon(skew.parts).measure() == doctest::Approx(0.8));
  CHECK(read_domain("lattice:0,1,0/1,0,0/0,0,2").domain.measure() == doctest::Approx(2));
  CHECK(says(refusal([] { read_domain("sphere:0"); }), "invalid_argument: domain sphere:0: the resolution"));
  CHECK(says(refusal([] { read_domain("disk:9x"); }), "the resolution is not a whole number"));
  CHECK(says(refusal([] { read_domain("square:4"); }), "square takes no resolution"));
  CHECK(says(refusal([] { read_domain("ball", DomainKind::surface); }),
             "domain ball is a volume, but a surface is wanted"));
}

TEST_CASE("files become domains of the right kind and measure") {
  for (const char* file :
       {"cube.mesh", "cube_41_binary.msh", "cube_vtk_51_binary.vtk", "cube_vtk_appended_raw_zlib.vtu"}) {
    CAPTURE(file);
    const LoadedDomain loaded = read_domain(data(file));
    CHECK(loaded.domain.kind() == DomainKind::volume);
    CHECK(loaded.domain.measure() == doctest::Approx(1).epsilon(1e-12));
    CHECK(says(loaded.description, "volume, " + std::to_string(loaded.vertices.size() / 3) + " vertices, " +
                                       std::to_string(loaded.elements.size() / 4) + " tetrahedra"));
  }
  for (const char* file : {"cube.off", "cube.obj", "cube_ascii.ply", "cube_ascii.stl"}) {
    CAPTURE(file);
    const LoadedDomain loaded = read_domain(data(file));
    CHECK(loaded.domain.kind() == DomainKind::surface);
    CHECK(loaded.domain.measure() == doctest::Approx(6).epsilon(1e-6));
  }
  const TemporaryFolder folder;
  const LoadedDomain hole = read_domain(folder.write(
      "hole.geojson",
      R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[1,2],[2,2],[2,1],[1,1]]]})"));
  CHECK(hole.domain.measure() == doctest::Approx(15));
  CHECK(says(hole.description, "hole.geojson: polygon, 1 part, 1 hole, 8 points"));
  CHECK(read_domain(folder.write("SHAPE.SVG", "<svg><circle r='1'/></svg>")).domain.measure() ==
        doctest::Approx(std::numbers::pi).epsilon(1e-3));
  CHECK(read_domain(folder.write("a.txt", "3 1\n0 0\n1 0\n0 1\n0 1 2\n")).domain.measure() ==
        doctest::Approx(0.5));
}

TEST_CASE("errors of the library name the file") {
  const TemporaryFolder folder;
  const std::string bow = folder.write("bow.wkt", "POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))");
  const std::string message = refusal([&] { read_domain(bow); });
  CHECK(says(message, "invalid_domain: "));
  CHECK(says(message, "bow.wkt: "));
}

TEST_CASE("random seeds are in the domain, uniform and reproducible") {
  for (const char* spec : {"square", "disk:64", "cube", "ball:6", "sphere:12"}) {
    CAPTURE(spec);
    const Domain domain = read_domain(spec).domain;
    const SeedTable seeds = read_seeds("random:20000:-1:3:5", domain);
    REQUIRE(seeds.count() == 20000);
    CHECK(seeds.dimension == domain.dimension());
    const std::size_t d = static_cast<std::size_t>(seeds.dimension);
    std::array<double, 3> mean{};
    for (std::size_t k = 0; k < seeds.positions.size(); ++k) {
      mean[k % d] += seeds.positions[k] / 20000;
      CHECK_UNARY(seeds.positions[k] >= domain.low()[k % d] && seeds.positions[k] <= domain.high()[k % d]);
    }
    // All five are symmetric about the middle of their box. Tolerance: four standard deviations of a mean.
    for (std::size_t axis = 0; axis < d; ++axis) {
      const double width = domain.high()[axis] - domain.low()[axis];
      CHECK(std::abs(mean[axis] - (domain.low()[axis] + domain.high()[axis]) / 2) <
            4 * width / 2 / std::sqrt(20000.0));
    }
    CHECK(*std::min_element(seeds.weights.begin(), seeds.weights.end()) >= -1);
    CHECK(*std::max_element(seeds.weights.begin(), seeds.weights.end()) <= 3);
    CHECK(read_seeds("random:20000:-1:3:5", domain).positions == seeds.positions);
    CHECK(read_seeds("random:20000:-1:3:6", domain).positions != seeds.positions);
    CHECK(read_seeds("random:10", domain).weights == std::vector<double>(10, 0.0));
  }
}

TEST_CASE("random seeds fill a tetrahedron evenly") {
  const TemporaryFolder folder;
  const Domain domain =
      read_domain(folder.write("t.tet", "4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 2 3\n")).domain;
  const SeedTable seeds = read_seeds("random:40000", domain);
  // Eight tetrahedra of equal measure: four at the corners have a coordinate (or what is left of 1) above
  // 1/2.
  std::array<int, 5> count{};
  for (std::size_t k = 0; k < seeds.count(); ++k) {
    const double* p = &seeds.positions[3 * k];
    const double rest = 1 - p[0] - p[1] - p[2];
    CHECK_UNARY(std::min({p[0], p[1], p[2], rest}) >= -1e-15);
    ++count[p[0] > 0.5 ? 0 : p[1] > 0.5 ? 1 : p[2] > 0.5 ? 2 : rest > 0.5 ? 3 : 4];
  }
  for (int corner = 0; corner < 4; ++corner) CHECK(std::abs(count[corner] - 5000) < 4 * 67);
  CHECK(std::abs(count[4] - 20000) < 4 * 100);
}

TEST_CASE("the generator is the same on every machine") {
  const SeedTable seeds = read_seeds("random:2:0:1:1", read_domain("square").domain);
  // The 4th and the 8th number of the generator with seed 1, from a separate implementation in Python
  // (a seed in the plane takes four: one for the piece, two for the position, one for the weight).
  CHECK(seeds.weights == std::vector<double>{0x1.90b871ef099a8p-2, 0x1.865537311ec7ap-2});
}
