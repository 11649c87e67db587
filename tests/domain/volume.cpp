#include <doctest/doctest.h>

#include <cmath>
#include <powercell/shapes.hpp>

#include "tests/domain/check_mesh.hpp"

namespace powercell {
namespace {

using test::refusal;
using Indices = std::vector<std::uint32_t>;

Domain volume(const std::vector<double>& vertices, const Indices& tetrahedra) {
  return Domain::volume(vertices, tetrahedra);
}
const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, -1, -1, -1};

TEST_CASE("two tetrahedra, in any orientation, share one facet") {
  for (const Indices& tetrahedra : {Indices{0, 1, 2, 3, 1, 2, 3, 4}, Indices{1, 0, 2, 3, 1, 2, 4, 3}}) {
    const Domain domain = volume(corners, tetrahedra);
    test::check_mesh(domain);
    CHECK(domain.kind() == DomainKind::volume);
    CHECK(domain.cell_dimension() == 3);
    CHECK(domain.measure() == 0.5);
    CHECK(domain.region_count() == 2);
    CHECK(domain.mesh().boundary_count == 6);
    std::size_t interior = 0;
    for (std::uint32_t slot = 0; slot < 8; ++slot) {
      const Border border = domain.mesh().facet[slot];
      if (border.kind != Border::Kind::interior) continue;
      ++interior;
      CHECK(border.index == 1 - slot / 4);
      // Facet k is opposite vertex k.
      CHECK(domain.mesh().region_vertex[slot] == (slot < 4 ? 0 : 4));
    }
    CHECK(interior == 2);
  }
}

TEST_CASE("tetrahedra are adjacent also by repeated vertices") {
  std::vector<double> doubled = corners;
  doubled.insert(doubled.end(), {1, 0, -0.0, 0, 1, 0, 0, 0, 1});
  const Domain domain = volume(doubled, {0, 1, 2, 3, 6, 7, 8, 4});
  test::check_mesh(domain);
  CHECK(domain.mesh().boundary_count == 6);
}

TEST_CASE("flat tetrahedra are left out, slivers are kept, at any scale") {
  std::vector<double> v = corners;
  v.insert(v.end(), {1, 1, 0, 0.3, 0.3, 1e-9});
  const Domain domain = volume(v, {0, 1, 2, 6, 0, 1, 2, 7, 0, 0, 1, 2, 0, 1, 2, 5});
  test::check_mesh(domain);
  CHECK(domain.mesh().source == Indices{1, 3});
  CHECK(domain.measure() == doctest::Approx((1 + 1e-9) / 6).epsilon(1e-15));
  for (const double scale : {1e-90, 1e-6, 1e9}) {
    // A needle: thin in two directions, which is not flat.
    const std::vector<double> needle{0, 0, 0, scale, 0, 0, 0, 1e-9 * scale, 0, 0, 0, 1e-9 * scale};
    CHECK(volume(needle, {0, 1, 2, 3}).measure() ==
          doctest::Approx(1e-18 * std::pow(scale, 3) / 6).epsilon(1e-14));
  }
}

TEST_CASE("invalid volumes are refused, with the indices of the elements") {
  CHECK_CONTAINS(refusal([] { volume({}, {}); }), "has no tetrahedra");
  CHECK_CONTAINS(refusal([] { volume(corners, {0, 1, 2}); }), "4 vertex indices each, got 3");
  CHECK_CONTAINS(refusal([] { volume(corners, {0, 1, 2, 3, 1, 2, 3, 6}); }), "tetrahedron 1: vertex index 6");
  std::vector<double> broken = corners;
  broken[14] = std::nan("");
  CHECK_CONTAINS(refusal([&] { volume(broken, {0, 1, 2, 3}); }), "vertex 4: coordinate z is nan");
  CHECK_CONTAINS(refusal([] { volume(corners, {0, 1, 1, 2}); }), "all 1 tetrahedra are flat");
  // Flat tetrahedra, which are left out, do not change the indices in the message.
  CHECK_CONTAINS(refusal([] {
                   volume(corners, {0, 1, 2, 3, 0, 0, 0, 0, 1, 2, 3, 4, 1, 2, 3, 5});
                 }),
                 "tetrahedra 0, 2 and 3 share one facet");
  CHECK_CONTAINS(refusal([] { volume(corners, {1, 2, 3, 0, 1, 2, 3, 5}); }), "tetrahedra 0 and 1 overlap");
}

TEST_CASE("262,144 tetrahedra") {
  const TetrahedralMesh mesh = ball(32);
  const Domain domain = Domain::volume(mesh.vertices, mesh.tetrahedra);
  CHECK(domain.region_count() == 8 * 32 * 32 * 32);
  CHECK(domain.mesh().boundary_count == 8 * 32 * 32);
  CHECK(domain.measure() == doctest::Approx(4 * 3.14159265358979 / 3).epsilon(2e-3));
}

}  // namespace
}  // namespace powercell
