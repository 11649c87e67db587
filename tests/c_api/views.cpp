// Results in the memory of a handle are those of C++, and last as long as the headers say.
#include <algorithm>
#include <cstring>
#include <powercell/powercell.hpp>
#include <random>

#include "tests/c_api/handles.hpp"
#include "tests/support/setups.hpp"

using namespace powercell::c_api_test;

namespace {

std::vector<double> random_numbers(std::size_t count, double most, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, most);
  std::vector<double> numbers(count);
  for (double& x : numbers) x = uniform(random);
  return numbers;
}

template <class T, class U>
void check_same(const T* view, std::size_t count, const std::vector<U>& expected) {
  REQUIRE(count * sizeof(T) == expected.size() * sizeof(U));
  if (count == 0) {
    CHECK(view == nullptr);
    return;
  }
  const bool same_bits = std::memcmp(view, expected.data(), count * sizeof(T)) == 0;  // of NaN too
  CHECK(same_bits);
}

/// The same diagram in C and in C++.
struct Twins {
  Domain domain;
  Diagram c;
  powercell::Diagram cpp;
  Twins(const powercell::Domain& of, pc_domain* made, int count)
      : cpp(powercell::test::test_device(), of),
        dimension(of.dimension()),
        n(static_cast<std::size_t>(count)) {
    domain.handle = made;
    positions = random_numbers(n * static_cast<std::size_t>(dimension), 1, 3);
    weights = random_numbers(n, 0.01, 4);
    REQUIRE(pc_diagram_create(shared_device(), made, nullptr, &c.handle) == PC_OK);
    REQUIRE(pc_diagram_set_seeds(c.handle, positions.data(), weights.data(), n) == PC_OK);
    cpp.set_seeds({dimension, positions, weights});
  }
  int dimension;
  std::size_t n;
  std::vector<double> positions, weights;
};

void check_measures(Twins& t) {
  const pc_measures* view = nullptr;
  REQUIRE(pc_diagram_measures_view(t.c.handle, &view) == PC_OK);
  const powercell::Measures& measures = t.cpp.measures();
  REQUIRE(view->count == t.n);
  CHECK(view->dimension == t.dimension);
  check_same(view->mass, t.n, measures.mass);
  check_same(view->centroid, t.n * static_cast<std::size_t>(t.dimension), measures.centroid);
  check_same(view->second_moment, t.n, measures.second_moment);
  check_same(view->status, t.n, measures.status);
  CHECK(view->domain_measure == measures.domain_measure);
  CHECK(view->total == measures.total());
  CHECK(view->relative_error == measures.relative_error());
  CHECK(view->status_count[PC_SEED_OK] == measures.count(powercell::SeedStatus::ok));
}

void check_adjacency(Twins& t) {
  const pc_adjacency* view = nullptr;
  REQUIRE(pc_diagram_adjacency_view(t.c.handle, &view) == PC_OK);
  const powercell::Adjacency& adjacency = t.cpp.adjacency();
  REQUIRE(view->count == t.n);
  check_same(view->offset, t.n + 1, adjacency.offset);
  check_same(view->neighbor, view->entry_count, adjacency.neighbor);
  check_same(view->wall, view->entry_count, adjacency.wall);
  check_same(view->shift, view->shift ? view->entry_count * 3 : 0, adjacency.shift);
  CHECK(view->asymmetry == adjacency.asymmetry);
  CHECK(view->asymmetric[1] == adjacency.asymmetric[1]);
}

void check_cells(Twins& t) {
  const pc_cells* view = nullptr;
  REQUIRE(pc_diagram_cells_view(t.c.handle, &view) == PC_OK);
  const powercell::Cells& cells = t.cpp.cells();
  REQUIRE(view->count == t.n);
  check_same(view->cell_offset, t.n + 1, cells.cell_offset);
  check_same(view->region, view->piece_count, cells.region);
  check_same(view->vertex_offset, view->piece_count + 1, cells.vertex_offset);
  check_same(view->vertices, view->vertex_count * static_cast<std::size_t>(t.dimension), cells.vertices);
  check_same(view->face_offset, view->piece_count + 1, cells.face_offset);
  REQUIRE(view->face_count == cells.border.size());
  for (std::size_t f = 0; f < view->face_count; ++f) {
    CHECK(view->border[f].kind == static_cast<std::uint32_t>(cells.border[f].kind));
    CHECK(view->border[f].index == cells.border[f].index);
  }
  check_same(view->shift, view->shift ? view->face_count * 3 : 0, cells.shift);
  check_same(view->loop_offset, cells.loop_offset.size(), cells.loop_offset);
  check_same(view->loop, cells.loop.size(), cells.loop);
  CHECK(view->cell_dimension == cells.cell_dimension);
}

void check_joined(Twins& t) {
  const pc_joined_cells* view = nullptr;
  REQUIRE(pc_diagram_joined_view(t.c.handle, &view) == PC_OK);
  const powercell::JoinedCells& joined = t.cpp.joined();
  REQUIRE(view->count == t.n);
  check_same(view->vertex_offset, t.n + 1, joined.vertex_offset);
  check_same(view->vertices, view->vertex_count * static_cast<std::size_t>(t.dimension), joined.vertices);
  check_same(view->face_offset, t.n + 1, joined.face_offset);
  check_same(view->loop_offset, view->face_count + 1, joined.loop_offset);
  check_same(view->loop, view->loop_count, joined.loop);
  CHECK((view->face_border != nullptr) == !joined.face_border.empty());
  CHECK((view->edge_border != nullptr) == !joined.edge_border.empty());
  const std::size_t borders = joined.face_border.size() + joined.edge_border.size();
  check_same(view->shift, view->shift ? borders * 3 : 0, joined.shift);
}

void check_walls_and_dual(Twins& t) {
  const pc_boundary_walls* walls = nullptr;
  REQUIRE(pc_diagram_boundary_walls_view(t.c.handle, &walls) == PC_OK);
  check_same(walls->offset, walls->count + 1, t.cpp.boundary_walls().offset);
  check_same(walls->facet, walls->entry_count, t.cpp.boundary_walls().facet);
  check_same(walls->measure, walls->entry_count, t.cpp.boundary_walls().measure);
  const pc_dual* dual = nullptr;
  REQUIRE(pc_diagram_dual_view(t.c.handle, &dual) == PC_OK);
  CHECK(dual->corners == t.cpp.dual().corners);
  check_same(dual->simplices, dual->count * static_cast<std::size_t>(dual->corners), t.cpp.dual().simplices);
  check_same(dual->shift, dual->shift ? dual->count * static_cast<std::size_t>(dual->corners) * 3 : 0,
             t.cpp.dual().shift);
}

void check_all(Twins& t, bool has_pieces) {
  REQUIRE(pc_diagram_compute(t.c.handle, 1, has_pieces) == PC_OK);
  t.cpp.compute(true, has_pieces);
  const pc_timings* timings = nullptr;
  REQUIRE(pc_diagram_timings_view(t.c.handle, &timings) == PC_OK);
  CHECK(timings->total > 0);
  CHECK(timings->pair_count >= t.n);
  check_measures(t);
  check_adjacency(t);
  if (has_pieces) check_cells(t);
  check_joined(t);
  check_walls_and_dual(t);
}

}  // namespace

TEST_CASE("views have the bits of C++, in a box, a surface, a volume and a solid") {
  pc_domain* made = nullptr;
  const double unit[3] = {1, 1, 1};
  REQUIRE(pc_domain_box(low, unit, 2, &made) == PC_OK);
  Twins box(powercell::Domain::box(std::span(low, 2), std::span(unit, 2)), made, 50);
  check_all(box, true);

  const powercell::TriangleMesh sphere = powercell::sphere(2);
  REQUIRE(pc_domain_surface(sphere.vertices.data(), sphere.vertices.size() / 3, sphere.triangles.data(),
                            sphere.triangles.size() / 3, &made) == PC_OK);
  Twins surface(powercell::Domain::surface(sphere.vertices, sphere.triangles), made, 30);
  check_all(surface, true);

  const powercell::TetrahedralMesh ball = powercell::ball(1);
  REQUIRE(pc_domain_volume(ball.vertices.data(), ball.vertices.size() / 3, ball.tetrahedra.data(),
                           ball.tetrahedra.size() / 4, &made) == PC_OK);
  Twins volume(powercell::Domain::volume(ball.vertices, ball.tetrahedra), made, 30);
  check_all(volume, true);

  REQUIRE(pc_domain_solid(sphere.vertices.data(), sphere.vertices.size() / 3, sphere.triangles.data(),
                          sphere.triangles.size() / 3, &made) == PC_OK);
  Twins solid(powercell::Domain::solid(sphere.vertices, sphere.triangles), made, 30);
  check_all(solid, false);
  const pc_cells* cells = nullptr;
  CHECK(pc_diagram_cells_view(solid.c.handle, &cells) == PC_UNSUPPORTED);
  CHECK(cells == nullptr);
}

TEST_CASE("periodic boxes and lattices have shifts in every view that may have them") {
  const double unit[3] = {1, 1, 1};
  const int along_x[3] = {1, 0, 0};
  pc_domain* made = nullptr;
  REQUIRE(pc_domain_periodic_box(low, unit, along_x, 3, &made) == PC_OK);
  const bool axes[3] = {true, false, false};
  Twins box(powercell::Domain::periodic_box(low, unit, axes), made, 40);
  check_all(box, true);

  const double vectors[4] = {1, 0, 0.5, 1};
  REQUIRE(pc_domain_lattice(vectors, nullptr, 2, &made) == PC_OK);
  Twins lattice(powercell::Domain::lattice(vectors), made, 40);
  check_all(lattice, true);
  const pc_adjacency* adjacency = nullptr;
  REQUIRE(pc_diagram_adjacency_view(lattice.c.handle, &adjacency) == PC_OK);
  REQUIRE(adjacency->shift != nullptr);
  const int32_t* end = adjacency->shift + 3 * adjacency->entry_count;
  CHECK(std::any_of(adjacency->shift, end, [](int32_t s) { return s != 0; }));
}

TEST_CASE("views are refused without a diagram or a place, and empty without seeds") {
  Grid f;
  const pc_measures* measures = nullptr;
  CHECK(pc_diagram_measures_view(nullptr, &measures) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_measures_view(f.diagram.handle, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_adjacency_view(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_cells_view(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_joined_view(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_boundary_walls_view(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_dual_view(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_timings_view(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_hold_results(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_compute(nullptr, 1, 1) == PC_INVALID_ARGUMENT);

  REQUIRE(pc_diagram_set_seeds(f.diagram.handle, nullptr, nullptr, 0) == PC_OK);
  const pc_cells* cells = nullptr;
  const pc_joined_cells* joined = nullptr;
  const pc_adjacency* adjacency = nullptr;
  REQUIRE(pc_diagram_measures_view(f.diagram.handle, &measures) == PC_OK);
  CHECK(measures->count == 0);
  REQUIRE(pc_diagram_cells_view(f.diagram.handle, &cells) == PC_OK);
  CHECK(cells->count == 0);
  CHECK(cells->vertex_count == 0);
  REQUIRE(pc_diagram_joined_view(f.diagram.handle, &joined) == PC_OK);
  CHECK(joined->count == 0);
  REQUIRE(pc_diagram_adjacency_view(f.diagram.handle, &adjacency) == PC_OK);
  CHECK(adjacency->count == 0);
}

TEST_CASE("held results outlive new seeds and the diagram") {
  Results held;
  const pc_measures* measures = nullptr;
  const pc_joined_cells* joined = nullptr;
  {
    Grid f;
    REQUIRE(pc_diagram_measures_view(f.diagram.handle, &measures) == PC_OK);
    REQUIRE(pc_diagram_hold_results(f.diagram.handle, &held.handle) == PC_OK);
    REQUIRE(pc_diagram_joined_view(f.diagram.handle, &joined) == PC_OK);  // after it was held
    const double heavy[4] = {100, 0, 0, 0};
    REQUIRE(pc_diagram_set_weights(f.diagram.handle, heavy, 4) == PC_OK);
    const pc_measures* later = nullptr;
    REQUIRE(pc_diagram_measures_view(f.diagram.handle, &later) == PC_OK);
    CHECK(later->mass[0] == doctest::Approx(2).epsilon(1e-5));
  }
  REQUIRE(measures->count == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(measures->mass[i] == doctest::Approx(0.5).epsilon(1e-5));
  REQUIRE(joined->count == 4);
  CHECK(joined->vertex_count == 16);
  pc_results_destroy(nullptr);
}

TEST_CASE("selected cells are rows of their own, until all are selected again") {
  Grid f;
  int selected = 9;
  const uint32_t seeds[2] = {3, 1}, outside[1] = {4};
  REQUIRE(pc_diagram_has_selection(f.diagram.handle, &selected) == PC_OK);
  CHECK(selected == 0);
  REQUIRE(pc_diagram_select(f.diagram.handle, seeds, 2) == PC_OK);
  REQUIRE(pc_diagram_has_selection(f.diagram.handle, &selected) == PC_OK);
  CHECK(selected == 1);
  const pc_measures* measures = nullptr;
  REQUIRE(pc_diagram_measures_view(f.diagram.handle, &measures) == PC_OK);
  REQUIRE(measures->count == 2);
  CHECK(measures->centroid[0] == doctest::Approx(1.5).epsilon(1e-5));
  CHECK(measures->centroid[1] == doctest::Approx(0.75).epsilon(1e-5));
  const pc_dual* dual = nullptr;
  CHECK(pc_diagram_dual_view(f.diagram.handle, &dual) == PC_UNSUPPORTED);
  CHECK(pc_diagram_select(f.diagram.handle, outside, 1) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_select(f.diagram.handle, nullptr, 1) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_diagram_select_all(f.diagram.handle) == PC_OK);
  REQUIRE(pc_diagram_measures_view(f.diagram.handle, &measures) == PC_OK);
  CHECK(measures->count == 4);
  CHECK(pc_diagram_select_all(nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_has_selection(nullptr, &selected) == PC_INVALID_ARGUMENT);
}

TEST_CASE("a diagram tells its seeds, precision, domain and device") {
  Grid f;
  std::vector<double> positions(8);
  REQUIRE(pc_diagram_positions(f.diagram.handle, positions.data()) == PC_OK);
  CHECK(positions == f.positions);
  CHECK(pc_diagram_positions(f.diagram.handle, nullptr) == PC_INVALID_ARGUMENT);
  pc_precision precision = PC_PRECISION_AUTOMATIC;
  pc_neighbors neighbors = PC_NEIGHBORS_AUTOMATIC;
  REQUIRE(pc_diagram_precision(f.diagram.handle, &precision) == PC_OK);
  CHECK(precision != PC_PRECISION_AUTOMATIC);
  REQUIRE(pc_diagram_neighbors(f.diagram.handle, &neighbors) == PC_OK);
  CHECK(neighbors == PC_TREE);
  Domain domain;
  Device device;
  REQUIRE(pc_diagram_domain(f.diagram.handle, &domain.handle) == PC_OK);
  REQUIRE(pc_diagram_device(f.diagram.handle, &device.handle) == PC_OK);
  double measure = 0;
  REQUIRE(pc_domain_measure(domain.handle, &measure) == PC_OK);
  CHECK(measure == 2);
  CHECK(std::string(pc_device_name(device.handle)) == pc_device_name(shared_device()));
  CHECK(pc_diagram_precision(f.diagram.handle, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_neighbors(nullptr, &neighbors) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_domain(f.diagram.handle, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_device(nullptr, &device.handle) == PC_INVALID_ARGUMENT);
}

TEST_CASE("one-off measures and triangulations are those of C++") {
  Grid f;
  std::vector<double> mass(4);
  REQUIRE(pc_measure(shared_device(), f.domain.handle, f.positions.data(), nullptr, 4, nullptr, mass.data(),
                     nullptr, nullptr, nullptr) == PC_OK);
  for (const double m : mass) CHECK(m == doctest::Approx(0.5).epsilon(1e-5));
  CHECK(pc_measure(nullptr, f.domain.handle, f.positions.data(), nullptr, 4, nullptr, mass.data(), nullptr,
                   nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_measure(shared_device(), f.domain.handle, nullptr, nullptr, 4, nullptr, mass.data(), nullptr,
                   nullptr, nullptr) == PC_INVALID_ARGUMENT);

  const std::vector<double> positions = random_numbers(60, 1, 5);
  Owned<const pc_triangulation, pc_triangulation_destroy> triangulation;
  REQUIRE(pc_triangulation_create(shared_device(), 3, positions.data(), nullptr, 20, nullptr,
                                  &triangulation.handle) == PC_OK);
  const powercell::Dual dual =
      powercell::regular_triangulation(powercell::test::test_device(), {3, positions, {}});
  CHECK(triangulation->dual.corners == 4);
  check_same(triangulation->dual.simplices, triangulation->dual.count * 4, dual.simplices);
  const pc_triangulation* none = nullptr;
  CHECK(pc_triangulation_create(shared_device(), 4, positions.data(), nullptr, 15, nullptr, &none) ==
        PC_INVALID_ARGUMENT);
  CHECK(pc_triangulation_create(shared_device(), 3, positions.data(), nullptr, 20, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}

TEST_CASE("joining cells gives the joined cells of the diagram") {
  Grid f;
  const pc_cells* cells = nullptr;
  const pc_joined_cells* expected = nullptr;
  Owned<const pc_joined, pc_joined_destroy> joined;
  REQUIRE(pc_diagram_cells_view(f.diagram.handle, &cells) == PC_OK);
  REQUIRE(pc_join(f.domain.handle, cells, &joined.handle) == PC_OK);
  REQUIRE(pc_diagram_joined_view(f.diagram.handle, &expected) == PC_OK);
  REQUIRE(joined->cells.count == 4);
  REQUIRE(joined->cells.vertex_count == expected->vertex_count);
  CHECK(std::equal(expected->vertices, expected->vertices + 2 * expected->vertex_count,
                   joined->cells.vertices));
  REQUIRE(joined->cells.loop_count == expected->loop_count);
  CHECK(std::equal(expected->loop, expected->loop + expected->loop_count, joined->cells.loop));
  const pc_joined* none = nullptr;
  CHECK(pc_join(nullptr, cells, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_join(f.domain.handle, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_join(f.domain.handle, cells, nullptr) == PC_INVALID_ARGUMENT);
  Domain cube;
  REQUIRE(pc_domain_box(low, high, 3, &cube.handle) == PC_OK);
  CHECK(pc_join(cube.handle, cells, &none) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}

TEST_CASE("the laws of a saved diagram are checked from its arrays") {
  Grid f;
  const pc_measures* measures = nullptr;
  const pc_joined_cells* joined = nullptr;
  REQUIRE(pc_diagram_measures_view(f.diagram.handle, &measures) == PC_OK);
  REQUIRE(pc_diagram_joined_view(f.diagram.handle, &joined) == PC_OK);
  pc_saved_diagram saved;
  REQUIRE(pc_saved_diagram_init(&saved, sizeof saved) == PC_OK);
  REQUIRE(pc_diagram_precision(f.diagram.handle, &saved.precision) == PC_OK);
  saved.kind = PC_POLYGON;
  saved.count = 4;
  saved.dimension = saved.cell_dimension = 2;
  saved.positions = f.positions.data();
  saved.domain_measure = measures->domain_measure;
  saved.mass = measures->mass;
  saved.centroid = measures->centroid;
  saved.status = measures->status;
  saved.vertex_offset = joined->vertex_offset;
  saved.vertices = joined->vertices;
  saved.face_offset = joined->face_offset;
  saved.loop_offset = joined->loop_offset;
  saved.loop = joined->loop;
  saved.edge_border = joined->edge_border;
  const auto passed = [&] {
    Owned<const pc_law_checks, pc_law_checks_destroy> checks;
    REQUIRE(pc_saved_diagram_verify(&saved, nullptr, &checks.handle) == PC_OK);
    CHECK(checks->count > 3);
    return checks->passed == 1;
  };
  CHECK(passed());
  std::vector<double> wrong(measures->mass, measures->mass + 4);
  wrong[2] *= 1.01;
  saved.mass = wrong.data();
  CHECK(!passed());
  saved.mass = measures->mass;

  const pc_law_checks* none = nullptr;
  const auto refused = [&] { return pc_saved_diagram_verify(&saved, nullptr, &none) == PC_INVALID_ARGUMENT; };
  saved.dimension = 4;
  CHECK(refused());
  saved.dimension = 2;
  saved.kind = static_cast<pc_domain_kind>(3);
  CHECK(refused());
  saved.kind = PC_POLYGON;
  const std::vector<std::uint32_t> outside(joined->loop_count, 99);
  saved.loop = outside.data();
  CHECK(refused());
  saved.loop = nullptr;
  CHECK(refused());
  saved.loop = joined->loop;
  const std::uint8_t status[4] = {0, 0, 3, 0};
  saved.status = status;
  CHECK(refused());
  saved.status = measures->status;
  saved.struct_size = 8;
  CHECK(refused());
  CHECK(pc_saved_diagram_verify(nullptr, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_saved_diagram_verify(&saved, nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_saved_diagram_init(&saved, 8) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}

TEST_CASE("the laws of a diagram are checked, and bad options are refused") {
  Grid f;
  Owned<const pc_law_checks, pc_law_checks_destroy> checks;
  REQUIRE(pc_diagram_verify(f.diagram.handle, f.positions.data(), nullptr, 4, nullptr, &checks.handle) ==
          PC_OK);
  CHECK(checks->passed == 1);
  REQUIRE(checks->count > 3);
  for (std::size_t k = 0; k < checks->count; ++k) {
    CHECK(checks->checks[k]->passed == 1);
    CHECK(std::string(checks->checks[k]->law) != "");
  }
  // Other seeds than those of the diagram break the laws.
  const double others[8] = {0.1, 0.25, 1.2, 0.25, 0.5, 0.95, 1.9, 0.75};
  Owned<const pc_law_checks, pc_law_checks_destroy> broken;
  REQUIRE(pc_diagram_verify(f.diagram.handle, others, nullptr, 4, nullptr, &broken.handle) == PC_OK);
  CHECK(broken->passed == 0);

  pc_verify_options options;
  REQUIRE(pc_verify_options_init(&options, sizeof options) == PC_OK);
  CHECK(options.samples == 1000);
  options.progress = [](double, void*) { return 0; };
  const pc_law_checks* none = nullptr;
  CHECK(pc_diagram_verify(f.diagram.handle, f.positions.data(), nullptr, 4, &options, &none) ==
        PC_INTERRUPTED);
  options.struct_size = 3;
  CHECK(pc_diagram_verify(f.diagram.handle, f.positions.data(), nullptr, 4, &options, &none) ==
        PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_verify(f.diagram.handle, f.positions.data(), nullptr, 4, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}
