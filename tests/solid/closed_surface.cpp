// Domain::solid: shells in shells, and surfaces that are refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <powercell/error.hpp>
#include <powercell/verify.hpp>

#include "tests/solid/both_ways.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The surface of a cube of the given edge, about the middle of the unit cube, outward or inward.
Mesh cube_surface(double edge, bool outward) {
  Random random(1);
  Mesh mesh = boundary_mesh(volume_of(cube_tetrahedra(2, 0, random)));
  for (double& x : mesh.vertices) x = 0.5 + edge * (x - 0.5);
  if (!outward)
    for (std::size_t t = 0; t < mesh.elements.size(); t += 3)
      std::swap(mesh.elements[t], mesh.elements[t + 1]);
  return mesh;
}

void add(Mesh& to, const Mesh& from, double dx = 0) {
  const auto first = static_cast<std::uint32_t>(to.vertex_count());
  for (std::size_t k = 0; k < from.vertices.size(); ++k)
    to.vertices.push_back(from.vertices[k] + (k % 3 == 0 ? dx : 0));
  for (const std::uint32_t v : from.elements) to.elements.push_back(first + v);
}

Domain solid_of(const Mesh& mesh) {
  return Domain::solid(mesh.vertices, mesh.elements);
}

/// The message with which a surface is refused.
std::string refusal(const Mesh& mesh) {
  try {
    solid_of(mesh);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_domain);
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("solid: shells in shells, however they are oriented") {
  for (int turned = 0; turned < 16; ++turned) {
    Mesh mesh;
    for (int k = 0; k < 3; ++k) add(mesh, cube_surface(1 - 0.25 * k, (turned >> k & 1) == 0));
    add(mesh, cube_surface(0.5, (turned >> 3 & 1) == 0), 3);
    const Domain domain = solid_of(mesh);
    CHECK(domain.kind() == DomainKind::volume);
    CHECK(domain.is_solid());
    CHECK(domain.region_count() == 0);
    CHECK(domain.measure() == doctest::Approx(1 - 27.0 / 64 + 1.0 / 8 + 1.0 / 8).epsilon(1e-15));
    CHECK(domain.low()[0] == 0);
    CHECK(domain.high()[0] == 3.75);
    if (!has_double()) continue;
    SeedArray seeds;
    seeds.push({0.5, 0.5, 0.5}, 0);
    seeds.push({3.5, 0.5, 0.5}, 0);
    for (const Setup& setup : main_setups()) {
      if (setup.options.neighbors != Neighbors::tree && setup.options.neighbors != Neighbors::automatic)
        continue;
      Diagram diagram(setup.device, domain, setup.options);
      diagram.set_seeds(seeds.view());
      CHECK(diagram.measures().mass[0] == doctest::Approx(1 - 27.0 / 64 + 1.0 / 8).epsilon(1e-14));
      CHECK(diagram.measures().mass[1] == doctest::Approx(1.0 / 8).epsilon(1e-14));
      CHECK(diagram.adjacency().neighbor.empty());
    }
  }
}

TEST_CASE("solid: surfaces that touch themselves in edges and vertices") {
  // Two cubes along an edge, and two in a corner.
  for (const bool edge : {true, false}) {
    Mesh mesh = cube_surface(1, true);
    Mesh other = cube_surface(1, false);
    for (std::size_t k = 0; k < other.vertices.size(); ++k)
      if (k % 3 < 2 || !edge) other.vertices[k] += 1;
    add(mesh, other);
    CHECK(solid_of(mesh).measure() == doctest::Approx(2).epsilon(1e-15));
  }
}

TEST_CASE("solid: bodies that share a face are one") {
  for (const bool turned : {false, true}) {
    Mesh mesh = cube_surface(1, true), mirrored = cube_surface(1, true);
    for (std::size_t k = 0; k < mirrored.vertices.size(); k += 3)
      mirrored.vertices[k] = 2 - mirrored.vertices[k];
    for (std::size_t k = 0; turned && k < mirrored.elements.size(); k += 3)
      std::swap(mirrored.elements[k], mirrored.elements[k + 1]);
    add(mesh, mirrored);
    const Domain domain = solid_of(mesh);
    CHECK(domain.measure() == doctest::Approx(2).epsilon(1e-15));
    CHECK(domain.report().repeated.size() == 8);  // triangles of a face
    CHECK(contains(domain.notes().at(0), "left out 8 pairs of triangles"));
    if (!has_double()) continue;
    SeedArray seeds;
    seeds.push({0.5, 0.5, 0.5}, 0);
    seeds.push({1.5, 0.5, 0.5}, 0);
    seeds.push({0.9, 0.5, 0.5}, 0);
    Diagram diagram(main_setups().front().device, domain);
    diagram.set_seeds(seeds.view());
    CHECK(diagram.measures().mass[0] == doctest::Approx(0.7).epsilon(1e-14));
    CHECK(diagram.measures().mass[2] == doctest::Approx(0.5).epsilon(1e-14));
    CHECK(diagram.adjacency().wall[0] == doctest::Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("solid: refused surfaces, with the place") {
  const Mesh cube = cube_surface(1, true);
  Mesh open = cube;
  open.elements.resize(open.elements.size() - 3);
  CHECK(contains(refusal(open), "open"));
  CHECK(contains(refusal(open), "the edge from ("));

  Mesh fin = cube;
  fin.vertices.insert(fin.vertices.end(), {2, 2, 2});
  fin.elements.insert(fin.elements.end(),
                      {fin.elements[0], fin.elements[1], static_cast<std::uint32_t>(fin.vertex_count() - 1)});
  CHECK(contains(refusal(fin), "triangle"));

  Mesh turned = cube;
  std::swap(turned.elements[0], turned.elements[1]);
  CHECK(contains(refusal(turned), "inside out in a part"));

  Mesh crossing = cube;
  add(crossing, cube, 0.25);
  CHECK(contains(refusal(crossing), "around ("));
  Mesh pierced = cube;
  add(pierced, cube_surface(0.5, true), 0.4);
  CHECK(contains(refusal(pierced), "crosses or touches itself"));
  CHECK(contains(refusal(pierced), "merge these into one surface"));
  Mesh twice = cube;
  add(twice, cube);
  CHECK(contains(refusal(twice), "the surface is there twice"));

  Mesh repeated = cube;
  repeated.elements.insert(repeated.elements.end(), cube.elements.begin(), cube.elements.begin() + 3);
  CHECK(contains(refusal(repeated),
                 "triangles 0 and " + std::to_string(cube.elements.size() / 3) + " at the edge"));
  CHECK(contains(refusal(repeated), "leave one of them out"));

  Mesh flat = cube;
  flat.vertices.insert(flat.vertices.end(), {5, 5, 5, 6, 6, 6, 7, 7, 7});
  const auto last = static_cast<std::uint32_t>(flat.vertex_count());
  flat.elements.insert(flat.elements.end(), {last - 3, last - 2, last - 1, last - 1, last - 2, last - 3});
  CHECK(contains(refusal(flat), "flat"));

  // A triangle whose corners are two is left out.
  Mesh degenerate = cube;
  degenerate.elements.insert(degenerate.elements.end(), {0, 1, 1});
  CHECK(solid_of(degenerate).report().flat.size() == 1);
  CHECK(solid_of(degenerate).notes().size() == 1);
  CHECK(refusal({{0, 0, 0, 1, 0, 0}, {0, 1, 1}}) != "");
  CHECK(contains(refusal({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 3}}), "out of range"));
}

TEST_CASE("solid: what needs convex pieces, and single precision, are refused") {
  if (!has_double()) return;
  const Domain domain = solid_of(cube_surface(1, true));
  const auto code_of = [](const std::function<void()>& action) {
    try {
      action();
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::internal;
  };
  const Setup& setup = main_setups().front();
  SeedArray seeds;
  seeds.push({0.2, 0.5, 0.5}, 0);
  seeds.push({0.7, 0.5, 0.5}, 0);
  Diagram diagram(setup.device, domain, setup.options);
  diagram.set_seeds(seeds.view());
  CHECK(code_of([&] { diagram.cells(); }) == ErrorCode::unsupported);
  CHECK(diagram.dual().size() == 0);
  CHECK(std::ranges::count(diagram.joined().face_border, Border::Kind::wall, &Border::kind) == 2);
  CHECK(code_of([&] { join(domain, {}); }) == ErrorCode::invalid_argument);
  for (const LawCheck& law : verify(diagram, seeds.view())) {
    CAPTURE(law.law);
    CHECK(law.passed);
  }
  CHECK(diagram.measures().mass[0] == doctest::Approx(0.45));
  CHECK(diagram.adjacency().wall[0] == doctest::Approx(1));
  // Fast decisions would not fit together.
  Options fast;
  fast.decisions = Decisions::fast;
  Diagram decided_exactly(setup.device, domain, fast);
  decided_exactly.set_seeds(seeds.view());
  CHECK(decided_exactly.measures().mass == diagram.measures().mass);
  Options single;
  single.precision = Precision::float32;
  CHECK(code_of([&] { Diagram(setup.device, domain, single); }) == ErrorCode::unsupported);
}
