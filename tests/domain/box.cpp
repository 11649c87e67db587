#include <doctest/doctest.h>

#include <cmath>

#include "tests/domain/check_mesh.hpp"

namespace powercell {
namespace {

using test::refusal;

Domain box(std::vector<double> low, std::vector<double> high) {
  return Domain::box(low, high);
}

TEST_CASE("a box in the plane is one convex polygon") {
  const Domain domain = box({-1, 2}, {3, 2.5});
  test::check_mesh(domain);
  CHECK(domain.kind() == DomainKind::polygon);
  CHECK(domain.mesh().shape == RegionShape::polygon);
  CHECK(domain.cell_dimension() == 2);
  CHECK(domain.measure() == 2);
  CHECK(domain.mesh().vertices == std::vector<double>{-1, 2, 3, 2, 3, 2.5, -1, 2.5});
  CHECK(domain.mesh().boundary_count == 4);
}

TEST_CASE("a box in space is one region of 8 corners and 6 facets") {
  const Domain domain = box({1e9, -1, 0}, {1e9 + 2, 1, 0.25});
  const RegionMesh& mesh = domain.mesh();
  CHECK(domain.kind() == DomainKind::volume);
  CHECK(mesh.shape == RegionShape::box);
  CHECK(domain.cell_dimension() == 3);
  CHECK(domain.measure() == 1);
  CHECK(domain.region_count() == 1);
  CHECK(domain.low() == std::array{1e9, -1.0, 0.0});
  CHECK(domain.high() == std::array{1e9 + 2, 1.0, 0.25});
  REQUIRE(mesh.region_vertex.size() == 8);
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    CHECK(mesh.region_vertex[corner] == corner);
    for (int k = 0; k < 3; ++k) {
      CHECK(mesh.vertices[3 * corner + k] == ((corner >> k) & 1 ? domain.high() : domain.low())[k]);
    }
  }
  REQUIRE(mesh.facet.size() == 6);
  CHECK(mesh.facet_offset == std::vector<std::uint32_t>{0, 6});
  for (std::uint32_t k = 0; k < 6; ++k) CHECK(mesh.facet[k] == Border{Border::Kind::boundary, k});
  CHECK(mesh.boundary_count == 6);
}

TEST_CASE("invalid boxes are refused") {
  CHECK_CONTAINS(refusal([] { box({0, 0}, {1, 1, 1}); }), "got 2 and 3");
  CHECK_CONTAINS(refusal([] { box({0}, {1}); }), "got 1 and 1");
  CHECK_CONTAINS(refusal([] { box({0, 0}, {1, std::nan("")}); }), "axis y: a corner is not finite");
  CHECK_CONTAINS(refusal([] { box({0, 0, 3}, {1, 1, 3}); }), "axis z: low");
  CHECK_CONTAINS(refusal([] { box({0, 2}, {1, 1}); }), "axis y: low");
  CHECK_CONTAINS(refusal([] { box({1e-9, 0}, {1e-10, 1}); }), "low 1e-09 is not less than high 1e-10");
  CHECK_CONTAINS(refusal([] { box({0, 0, 0}, {1e200, 1e200, 1}); }), "magnitude 1e+200");
  CHECK_CONTAINS(refusal([] { box({-1e101, 0, 0}, {1, 1, 1}); }), "magnitude 1e+101");
  CHECK_CONTAINS(refusal([] { box({0, 0}, {1e-101, 1e-101}); }), "magnitude 1e-101");
  CHECK_CONTAINS(refusal([] { box({0, 0, 0}, {1, 1e-300, 1e-300}); }), "volume of the domain is 0");
}

}  // namespace
}  // namespace powercell
