#include <cairo.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <pugixml.hpp>
#include <set>

#include "apps/io/picture/light.hpp"
#include "apps/io/picture/models.hpp"
#include "apps/io/picture/outline.hpp"
#include "apps/io/picture/scene.hpp"
#include "apps/io/write/output.hpp"
#include "tests/writers/clip_pieces.hpp"
#include "tests/writers/made_diagram.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

// Area inside the rings of an SVG path of M, l (relative) and z, the only commands written.
double path_area(const std::string& d) {
  double area = 0, x = 0, y = 0, first_x = 0, first_y = 0;
  const char* at = d.c_str();
  while (*at) {
    const char command = *at++;
    if (command == 'z') {
      area += (x * first_y - first_x * y) / 2;
      continue;
    }
    REQUIRE((command == 'M' || command == 'l'));
    char* end;
    const double u = std::strtod(at, &end);
    const double v = std::strtod(end, &end);
    at = end;
    if (command == 'M') {
      first_x = x = u;
      first_y = y = v;
      continue;
    }
    area += (x * (y + v) - (x + u) * y) / 2;
    x += u;
    y += v;
  }
  return -area;  // y runs down
}

double ring_area(const Ring& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto &a = ring[k], &b = ring[(k + 1) % ring.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

double triangle_area(const io::Model::Triangle& t) {
  return 0.5 *
         static_cast<double>(io::length(io::cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0])));
}

}  // namespace

TEST_CASE("the outline of a polygon is its boundary, not that of its convex pieces") {
  const MadeDiagram made = polygon_diagram(1);
  const auto rings = io::boundary_rings(made.domain);
  REQUIRE(rings.size() == 2);
  CHECK(ring_area(rings[0]) * ring_area(rings[1]) < 0);  // the hole runs the other way
  CHECK(ring_area(rings[0]) + ring_area(rings[1]) == doctest::Approx(made.domain.measure()).epsilon(1e-12));
}

TEST_CASE("an SVG has one path for each cell, addressable, of the cell's area") {
  TemporaryFolder folder;
  const MadeDiagram made = polygon_diagram(80);
  io::write_output(folder.file("d.svg"), made.output());
  pugi::xml_document document;
  REQUIRE(document.load_file(folder.file("d.svg").c_str()));
  const auto svg = document.child("svg");
  CHECK(std::string(svg.child("title").text().get()).find("80 seeds") != std::string::npos);
  CHECK(svg.child("desc"));
  const double extent = std::max(svg.attribute("width").as_double(), svg.attribute("height").as_double());
  CHECK(extent == 1600);
  double scale = 0;
  const auto low = made.domain.low(), high = made.domain.high();
  scale = 1600 * 0.96 / std::max(high[0] - low[0], high[1] - low[1]);
  std::size_t cells = 0;
  for (const auto path : svg.find_child_by_attribute("class", "cells").children("path")) {
    const auto seed = path.attribute("data-seed").as_ullong();
    CHECK(path.attribute("id").as_string() == "cell-" + std::to_string(seed));
    const double area = path_area(path.attribute("d").as_string()) / (scale * scale);
    CHECK(area == doctest::Approx(made.measures.mass.at(seed)).epsilon(0.01));
    ++cells;
  }
  CHECK(cells == made.measures.count(SeedStatus::ok));
}

TEST_CASE("discs show signs, hidden seeds and duplicates") {
  const MadeDiagram made = polygon_diagram(80);
  const io::Scene scene = io::make_scene(made.output());
  std::size_t positive = 0, negative = 0, duplicates = 0;
  for (const io::Scene::Disc& disc : scene.discs) {
    const double w = made.weights[disc.seed];
    const SeedStatus status = made.measures.status[disc.seed];
    if (disc.mark == io::Scene::Mark::positive) CHECK(w > 0);
    if (disc.mark == io::Scene::Mark::negative) CHECK(w < 0);
    if (disc.mark == io::Scene::Mark::hidden) CHECK(status == SeedStatus::hidden);
    if (disc.mark == io::Scene::Mark::dot) CHECK(status == SeedStatus::ok);
    positive += disc.mark == io::Scene::Mark::positive;
    negative += disc.mark == io::Scene::Mark::negative;
    duplicates += disc.mark == io::Scene::Mark::duplicate;
  }
  CHECK(positive > 0);
  CHECK(negative > 0);
  CHECK(duplicates == 1);
}

TEST_CASE("weights that are not radii are not drawn as discs") {
  const MadeDiagram made = polygon_diagram(80);
  io::DiagramOutput output = made.output();
  output.weights_as_discs = false;
  const io::Scene with = io::make_scene(made.output()), without = io::make_scene(output);
  const auto of_weights = [](const io::Scene::Disc& disc) {
    return disc.mark == io::Scene::Mark::positive || disc.mark == io::Scene::Mark::negative;
  };
  const auto drawn = std::count_if(with.discs.begin(), with.discs.end(), of_weights);
  CHECK(drawn > 0);
  CHECK(std::none_of(without.discs.begin(), without.discs.end(), of_weights));
  CHECK(without.discs.size() + static_cast<std::size_t>(drawn) == with.discs.size());
  CHECK(with.description.find("sqrt(weight)") != std::string::npos);
  CHECK(without.description.find("sqrt(weight)") == std::string::npos);
}

TEST_CASE("cells with a common wall differ in colour") {
  const MadeDiagram made = polygon_diagram(200);
  const auto colours = io::cell_colours(made.adjacency, made.weights.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    for (std::uint64_t e = made.adjacency.offset[i]; e < made.adjacency.offset[i + 1]; ++e) {
      const io::Colour a = colours[i], b = colours[made.adjacency.neighbor[e]];
      const int apart = std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
      CHECK(apart > 30);
    }
  }
}

TEST_CASE("a PNG can be read, has the right size and shows cells on white") {
  TemporaryFolder folder;
  const MadeDiagram flat = polygon_diagram(60), surface = surface_diagram(15), solid = volume_diagram(20);
  for (const MadeDiagram* made : {&flat, &surface, &solid}) {
    io::write_output(folder.file("d.png"), made->output());
    cairo_surface_t* image = cairo_image_surface_create_from_png(folder.file("d.png").c_str());
    REQUIRE(cairo_surface_status(image) == CAIRO_STATUS_SUCCESS);
    const int width = cairo_image_surface_get_width(image), height = cairo_image_surface_get_height(image);
    CHECK(std::abs(std::max(width, height) - 1600) <= 1);
    const unsigned char* pixels = cairo_image_surface_get_data(image);
    const int stride = cairo_image_surface_get_stride(image);
    std::set<std::uint32_t> colours;
    int coloured = 0;
    for (int y = 0; y < height; y += 7) {
      for (int x = 0; x < width; x += 7) {
        std::uint32_t pixel;
        std::memcpy(&pixel, pixels + std::ptrdiff_t{y} * stride + 4 * x, 4);
        colours.insert(pixel & 0xffffff);
        const int r = pixel >> 16 & 255, b = pixel & 255;
        coloured += std::abs(r - b) > 12;
      }
    }
    CHECK(colours.count(0xffffff) == 1);
    CHECK(colours.size() > 8);
    CHECK(coloured > (height / 7) * (width / 7) / 6);
    cairo_surface_destroy(image);
  }
}

TEST_CASE("the picture of a surface shows all of it, with each cell as a part") {
  const MadeDiagram made = surface_diagram(30);
  const io::Model model = io::surface_model(made.output());
  const auto low = made.domain.low(), high = made.domain.high();
  const double radius = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2;
  std::vector<double> area(made.weights.size());
  for (const auto& triangle : model.triangles)
    area.at(triangle.part) += triangle_area(triangle) * radius * radius;
  for (std::size_t i = 0; i < area.size(); ++i)
    CHECK(area[i] == doctest::Approx(made.measures.mass[i]).epsilon(1e-4));
}

TEST_CASE("a volume is opened: cells of the octant towards the camera are omitted") {
  const MadeDiagram made = volume_diagram(64);
  const io::Model model = io::volume_model(made.output());
  const io::Vec3 view = io::PictureStyle{}.towards;
  double six_volumes = 0;
  for (const auto& t : model.triangles)
    six_volumes += static_cast<double>(dot(t.corner[0], io::cross(t.corner[1], t.corner[2])));
  double kept = 0;
  for (std::size_t i = 0; i < made.weights.size(); ++i) {
    const double* c = &made.measures.centroid[3 * i];
    const bool front = (c[0] - 0.5) * view.x > 0 && (c[1] - 0.5) * view.y > 0 && (c[2] - 0.5) * view.z > 0;
    if (!front && made.measures.mass[i] > 0) kept += made.measures.mass[i];
  }
  const double scale = 2 / std::sqrt(3.0);
  CHECK(kept < 0.95);
  CHECK(six_volumes / 6 / std::pow(scale * 0.88, 3) == doctest::Approx(kept).epsilon(1e-4));
}

TEST_CASE("lines divide parts and creases, and nothing else") {
  // Two squares in one plane, and one that meets them at a right angle, seen from above.
  const auto square = [](io::Model& model, io::Vec3 at, io::Vec3 along, io::Vec3 across, std::uint32_t part) {
    const io::Vec3 normal = io::normalized(io::cross(along, across));
    for (const auto& [a, b] : {std::pair{along, along + across}, std::pair{along + across, across}})
      model.triangles.push_back(
          {{at, at + a, at + b}, {normal, normal, normal}, {200, 200, 200}, part, 0.9f});
  };
  const auto dark_pixels = [&](std::uint32_t second, std::uint32_t third) {
    io::Model model;
    model.line_width = 3;
    square(model, {-0.6f, -0.3f, 0}, {0.6f, 0, 0}, {0, 0.6f, 0}, 0);
    square(model, {0, -0.3f, 0}, {0.6f, 0, 0}, {0, 0.6f, 0}, second);
    square(model, {-0.6f, -0.3f, -0.6f}, {1.2f, 0, 0}, {0, 0, 0.6f}, third);
    const io::Image image = io::render(model, {.width = 400, .height = 400});
    std::ptrdiff_t dark = 0;
    for (std::size_t k = 0; k < image.rgb.size(); k += 3) dark += image.rgb[k] < 60;
    return dark;
  };
  const auto outline = dark_pixels(0, 0);  // around the whole, and at the crease
  CHECK(outline > 0);
  CHECK(dark_pixels(0, 1) == outline);      // a crease is drawn once
  CHECK(dark_pixels(1, 0) > outline + 50);  // and a border of two parts in one plane too
}

TEST_CASE("shadows: a place below a plate has no sun and little sky") {
  std::vector<io::Triangle> plate;
  plate.push_back({{{-0.5f, -0.5f, 0.1f}, {0.5f, -0.5f, 0.1f}, {0.5f, 0.5f, 0.1f}}});
  plate.push_back({{{-0.5f, -0.5f, 0.1f}, {0.5f, 0.5f, 0.1f}, {-0.5f, 0.5f, 0.1f}}});
  const io::Vec3 up{0, 0, 1};
  const std::vector<io::Place> places = {{{0, 0, 0}, up}, {{0, 0, 0.1f}, up}, {{0.9f, 0, 0}, up}};
  const auto light = io::light_on(places, 3, plate, up);
  CHECK(light[0].sun == 0);
  CHECK(light[0].sky < 0.2f);
  CHECK(light[1].sun == 1);  // it does not shade itself
  CHECK(light[1].sky == 1);
  CHECK(light[2].sun == 1);
  CHECK(light[2].sky < 1);
  CHECK(light[2].sky > 0.8f);
}

TEST_CASE("triangles that share edges leave no sample between them") {
  constexpr int corners = 37;
  const auto corner = [](int k) {
    const float angle = 6.2831853f * static_cast<float>(k % corners) / corners;
    return io::Projected{50.3f + 40.7f * std::cos(angle), 49.9f + 40.7f * std::sin(angle), 1};
  };
  io::Samples samples(100, 100);
  for (int k = 0; k < corners; ++k)
    samples.draw({io::Projected{47.1f, 52.3f, 1}, corner(k), corner(k + 1)}, static_cast<std::uint32_t>(k));
  std::size_t inside = 0, drawn = 0;
  for (int row = 0; row < 100; ++row)
    for (int column = 0; column < 100; ++column) {
      const bool here = samples.triangle[samples.at(column, row)] != io::Samples::nothing;
      const double away = std::hypot(column + 0.5 - 50.3, row + 0.5 - 49.9);
      if (away < 40.4) CHECK(here);
      if (away > 40.9) CHECK_FALSE(here);
      inside += away < 40.4;
      drawn += here;
    }
  CHECK(inside > 5000);
  CHECK(drawn >= inside);
}

TEST_CASE("pictures are reproducible") {
  const io::Model model = io::volume_model(volume_diagram(10).output());
  CHECK(io::render(model, {.width = 200, .height = 200}).rgb ==
        io::render(model, {.width = 200, .height = 200}).rgb);
  TemporaryFolder folder;
  const MadeDiagram made = polygon_diagram(30);
  for (const std::string extension : {".svg", ".png"}) {
    io::write_output(folder.file("a" + extension), made.output());
    io::write_output(folder.file("b" + extension), made.output());
    CHECK(read_all(folder.file("a" + extension)) == read_all(folder.file("b" + extension)));
  }
}

// Run by read_back.py, which reads the files with other programs.
TEST_CASE("files for other programs" * doctest::skip(std::getenv("POWERCELL_WRITERS_FOLDER") == nullptr)) {
  const char* to = std::getenv("POWERCELL_WRITERS_FOLDER");
  REQUIRE(to);
  const std::string folder = std::string(to) + "/";
  const MadeDiagram flat = polygon_diagram(120), surface = surface_diagram(40), solid = volume_diagram(60);
  for (const std::string extension : {".vtu", ".vtp", ".ply", ".obj", ".json", ".png"}) {
    io::write_output(folder + "polygon" + extension, flat.output());
    io::write_output(folder + "surface" + extension, surface.output());
    io::write_output(folder + "volume" + extension, solid.output());
  }
  io::write_output(folder + "polygon.svg", flat.output());
  io::write_output(folder + "polygon.pdf", flat.output());
  io::write_output(folder + "polygon.msh", flat.output());
  io::write_output(folder + "surface.msh", surface.output());
  io::DiagramOutput whole = solid.output();
  whole.whole_cells = true;
  io::write_output(folder + "whole.vtu", whole);
  for (const std::string extension : {".stl", ".msh"})
    io::write_output(folder + "volume" + extension, solid.output());
  CHECK(std::filesystem::exists(folder + "volume.vtu"));
}
