// Pictures by their style: size, camera, and colours with a legend.
#include <cairo.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "apps/io/picture/colour_scales.hpp"
#include "apps/io/picture/models.hpp"
#include "apps/io/picture/scene.hpp"
#include "apps/io/write/output.hpp"
#include "tests/writers/made_diagram.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct ReadPicture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;  // 0xrrggbb, row-major
};

ReadPicture read_png(const std::string& path) {
  cairo_surface_t* image = cairo_image_surface_create_from_png(path.c_str());
  REQUIRE(cairo_surface_status(image) == CAIRO_STATUS_SUCCESS);
  ReadPicture picture{cairo_image_surface_get_width(image), cairo_image_surface_get_height(image), {}};
  const unsigned char* data = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      picture.pixels.push_back(reinterpret_cast<const std::uint32_t*>(data + std::ptrdiff_t{y} * stride)[x] &
                               0xffffff);
  cairo_surface_destroy(image);
  return picture;
}

io::DiagramOutput coloured(const MadeDiagram& made, io::ColourBy::What what) {
  io::DiagramOutput output = made.output();
  output.style.colours.what = what;
  return output;
}

// A cube of side 1 about the origin, with a face of its own colour on each side.
io::Model cube() {
  io::Model model;
  const io::Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const io::Colour colours[] = {{200, 0, 0},   {0, 200, 0},   {0, 0, 200},
                                {200, 200, 0}, {0, 200, 200}, {200, 0, 200}};
  for (std::uint32_t k = 0; k < 6; ++k) {
    const float side = k % 2 == 0 ? 0.5f : -0.5f;
    const io::Vec3 normal = axes[k / 2] * (2 * side), u = axes[(k / 2 + 1) % 3], v = axes[(k / 2 + 2) % 3];
    const io::Vec3 middle = axes[k / 2] * side;
    const io::Vec3 corner[] = {middle + u * -0.5f + v * -0.5f, middle + u * 0.5f + v * -0.5f,
                               middle + u * 0.5f + v * 0.5f, middle + u * -0.5f + v * 0.5f};
    for (const auto& [a, b, c] : {std::array{0, 1, 2}, std::array{0, 2, 3}})
      model.triangles.push_back({{corner[a], corner[b], corner[c]}, {normal, normal, normal}, colours[k], k});
  }
  return model;
}

// The face in the middle of the picture, by its hue: the channels that are lit.
int face_in_the_middle(const io::View& view) {
  const io::Image image = io::render(cube(), view);
  const std::uint8_t* p =
      &image.rgb[3 * static_cast<std::size_t>(image.height / 2 * image.width + image.width / 2)];
  const int largest = std::max({p[0], p[1], p[2]});
  return (2 * p[0] > largest ? 1 : 0) + (2 * p[1] > largest ? 2 : 0) + (2 * p[2] > largest ? 4 : 0);
}

}  // namespace

TEST_CASE("the camera shows the side that it looks at") {
  const io::Vec3 z{0, 0, 1}, y{0, 1, 0};
  CHECK(face_in_the_middle({{1, 0, 0}, z, 200, 200}) == 1);
  CHECK(face_in_the_middle({{-1, 0, 0}, z, 200, 200}) == 2);
  CHECK(face_in_the_middle({{0, 1, 0}, z, 200, 200}) == 4);
  CHECK(face_in_the_middle({{0, -1, 0}, z, 200, 200}) == 3);
  CHECK(face_in_the_middle({{0, 0, 1}, y, 200, 200}) == 6);
  CHECK(face_in_the_middle({{0, 0, -1}, y, 200, 200}) == 5);
}

TEST_CASE("up is shown upwards") {
  for (const io::Vec3 up : {io::Vec3{0, 0, 1}, io::Vec3{0, 1, 0}, io::Vec3{0.3f, -0.4f, 0.2f}}) {
    const io::View view{{0.7f, 0.2f, 0.1f}, up, 300, 200};
    const std::vector<io::Vec3> points = {{0, 0, 0}, io::normalized(up) * 0.5f, {0.4f, 0.2f, -0.3f}};
    const io::Camera camera = io::fit_camera(view, points);
    const io::Projected from = camera.project(points[0]), to = camera.project(points[1]);
    CHECK(to.y < from.y);
    CHECK(std::abs(to.x - from.x) < 1e-3f * (from.y - to.y));
  }
}

TEST_CASE("a model fills its picture up to the margin, and is in the middle of an exact one") {
  const std::vector<io::Vec3> points = {
      {0.5f, 0.1f, 0.2f}, {-0.6f, 0.3f, 0}, {0, -0.7f, 0.4f}, {0, 0.2f, -0.5f}};
  for (const bool exact : {false, true})
    for (const auto& [width, height] : {std::pair{800, 800}, {900, 150}, {100, 700}}) {
      const io::Camera camera = io::fit_camera({{1, 1, 1}, {0, 0, 1}, width, height, exact}, points);
      float low[2] = {1e9f, 1e9f}, high[2] = {-1e9f, -1e9f};
      for (const io::Vec3& point : points) {
        const io::Projected at = camera.project(point);
        low[0] = std::min(low[0], at.x), high[0] = std::max(high[0], at.x);
        low[1] = std::min(low[1], at.y), high[1] = std::max(high[1], at.y);
      }
      const float margin = 0.04f * static_cast<float>(std::min(width, height));
      CHECK(camera.width <= width);
      CHECK(camera.height <= height);
      if (exact) CHECK((camera.width == width && camera.height == height));
      const float spare[2] = {static_cast<float>(camera.width) - (high[0] - low[0]) - 2 * margin,
                              static_cast<float>(camera.height) - (high[1] - low[1]) - 2 * margin};
      CHECK(std::min(spare[0], spare[1]) < 1.1f);  // one of the sides is filled
      CHECK(std::min(spare[0], spare[1]) > -0.1f);
      CHECK(std::abs(low[0] - margin - (exact ? spare[0] / 2 : 0)) < 0.1f);
      CHECK(std::abs(low[1] - margin - (exact ? spare[1] / 2 : 0)) < 0.1f);
    }
}

TEST_CASE("a volume is drawn whole on request, and opened towards any camera") {
  const MadeDiagram made = volume_diagram(64);
  const auto volume = [&](const io::PictureStyle& style) {
    io::DiagramOutput output = made.output();
    output.style = style;
    double six_volumes = 0;
    for (const auto& t : io::volume_model(output).triangles)
      six_volumes += static_cast<double>(dot(t.corner[0], io::cross(t.corner[1], t.corner[2])));
    return six_volumes / 6 / std::pow(2 / std::sqrt(3.0) * 0.88, 3);
  };
  CHECK(volume({.cut = false}) == doctest::Approx(1).epsilon(1e-4));
  for (const io::Vec3 towards : {io::Vec3{0, -1, 0}, io::Vec3{-1, 0, 1}, io::Vec3{-1, -2, -3}}) {
    double kept = 0;
    for (std::size_t i = 0; i < made.weights.size(); ++i) {
      const double* c = &made.measures.centroid[3 * i];
      if (!(made.measures.mass[i] > 0)) continue;
      bool front = true;  // as far as the camera has a side
      front = front && (towards.x == 0 || (c[0] - 0.5) * towards.x > 0);
      front = front && (towards.y == 0 || (c[1] - 0.5) * towards.y > 0);
      front = front && (towards.z == 0 || (c[2] - 0.5) * towards.z > 0);
      if (!front) kept += made.measures.mass[i];
    }
    CHECK(kept < 0.95);
    CHECK(volume({.towards = towards}) == doctest::Approx(kept).epsilon(1e-4));
  }
}

TEST_CASE("pictures have the size that is asked for, with a legend too") {
  TemporaryFolder folder;
  const MadeDiagram flat = polygon_diagram(40), surface = surface_diagram(12), solid = volume_diagram(12);
  for (const MadeDiagram* made : {&flat, &surface, &solid})
    for (const bool legend : {false, true})
      for (const io::PictureSize& size : {io::PictureSize{240, 0}, io::PictureSize{420, 0},
                                          io::PictureSize{320, 210}, io::PictureSize{210, 400}}) {
        io::DiagramOutput output =
            coloured(*made, legend ? io::ColourBy::What::measure : io::ColourBy::What::hues);
        output.style.size = size;
        io::write_output(folder.file("d.png"), output);
        const ReadPicture picture = read_png(folder.file("d.png"));
        CAPTURE(size.width);
        CAPTURE(size.height);
        if (size.height > 0) {
          CHECK(picture.width == size.width);
          CHECK(picture.height == size.height);
        } else {
          CHECK(std::abs(std::max(picture.width, picture.height) - size.width) <= 1);
        }
        // White all around: nothing is cut off. Seeds outside of a polygon may lie at the border.
        if (made == &flat) continue;
        int border = 0;
        for (int x = 0; x < picture.width; ++x)
          border += picture.pixels[static_cast<std::size_t>(x)] != 0xffffff ? 1 : 0;
        for (int y = 0; y < picture.height; ++y)
          border += picture.pixels[static_cast<std::size_t>(y * picture.width)] != 0xffffff ? 1 : 0;
        CHECK(border == 0);
      }
}

TEST_CASE("the legend of an SVG says for each cell which number its colour means") {
  TemporaryFolder folder;
  const MadeDiagram made = polygon_diagram(80);
  for (const io::ColourBy::What what :
       {io::ColourBy::What::measure, io::ColourBy::What::weight, io::ColourBy::What::neighbors}) {
    io::write_output(folder.file("d.svg"), coloured(made, what));
    pugi::xml_document document;
    REQUIRE(document.load_file(folder.file("d.svg").c_str()));
    const auto svg = document.child("svg");
    const auto legend = svg.find_child_by_attribute("class", "legend");
    // The colours along the bar, and two of its labelled ticks, say the number at each height.
    std::vector<std::string> stops;
    for (const auto stop : legend.child("linearGradient").children("stop"))
      stops.push_back(stop.attribute("stop-color").as_string());
    REQUIRE(stops.size() > 8);
    double bar_top = 0, bar_height = 0;
    for (const auto box : legend.children("rect"))
      if (box.attribute("fill").as_string() == std::string("url(#scale)"))
        bar_top = box.attribute("y").as_double(), bar_height = box.attribute("height").as_double();
    REQUIRE(bar_height > 0);
    std::map<double, double> number_at;  // by height
    for (const auto text : legend.children("text")) {
      const double y = text.attribute("y").as_double();
      if (y > bar_top - 1 && y < bar_top + bar_height + 1) number_at[y] = text.text().as_double();
    }
    REQUIRE(number_at.size() >= 2);
    const auto first = *number_at.begin(), last = *number_at.rbegin();
    const double per_pixel = (last.second - first.second) / (last.first - first.first);
    const std::string title = legend.child("text").text().get();
    const bool scaled = title.find("×10⁻³") != std::string::npos;
    std::set<double> heights;
    for (const auto path : svg.find_child_by_attribute("class", "cells").children("path")) {
      const auto i = path.attribute("data-seed").as_ullong();
      double value = made.measures.mass[i];
      if (what == io::ColourBy::What::weight) value = made.weights[i];
      if (what == io::ColourBy::What::neighbors)
        value = static_cast<double>(made.adjacency.offset[i + 1] - made.adjacency.offset[i]);
      if (scaled) value *= 1000;
      const double y = first.first + (value - first.second) / per_pixel;
      const double share = std::clamp((bar_top + bar_height - y) / bar_height, 0.0, 1.0);
      heights.insert(share);
      const double at = share * static_cast<double>(stops.size() - 1);
      const auto below = std::min(static_cast<std::size_t>(at), stops.size() - 2);
      const std::string fill = path.attribute("fill").as_string();
      for (std::size_t c = 1; c < 7; c += 2) {
        const auto channel = [&](const std::string& text) {
          return std::stoi(text.substr(c, 2), nullptr, 16);
        };
        const double t = at - static_cast<double>(below);
        const double meant = channel(stops[below]) * (1 - t) + channel(stops[below + 1]) * t;
        CHECK(std::abs(channel(fill) - meant) < 5);
      }
    }
    // The scale goes from the least to the greatest number.
    CHECK(*heights.begin() < 0.01);
    CHECK(*heights.rbegin() > 0.99);
  }
}

TEST_CASE("discs of weights do not darken colours that mean something") {
  const MadeDiagram made = polygon_diagram(80);
  const io::Scene scene = io::make_scene(coloured(made, io::ColourBy::What::measure));
  CHECK(std::none_of(scene.discs.begin(), scene.discs.end(), [](const io::Scene::Disc& disc) {
    return disc.mark == io::Scene::Mark::positive || disc.mark == io::Scene::Mark::negative;
  }));
  CHECK(scene.description.find("Colours show: area.") != std::string::npos);
  CHECK(scene.description.find("sqrt(weight)") == std::string::npos);
}

TEST_CASE("a legend counts the seeds without cells as the picture marks them") {
  const MadeDiagram made = polygon_diagram(80);
  const io::Scene scene = io::make_scene(coloured(made, io::ColourBy::What::measure));
  const auto texts = [](const io::LegendScene& legend) {
    std::set<std::string> all;
    for (const auto& text : legend.texts) all.insert(text.text);
    return all;
  };
  const std::size_t hidden = made.measures.count(SeedStatus::hidden);
  REQUIRE(hidden > 0);
  CHECK(texts(scene.legend).count("hidden (" + std::to_string(hidden) + ")") == 1);
  CHECK(texts(scene.legend).count("duplicate (1)") == 1);
  io::DiagramOutput without = coloured(made, io::ColourBy::What::measure);
  without.style.legend = false;
  CHECK(io::make_scene(without).legend.empty());
  CHECK(io::make_scene(made.output()).legend.empty());
}

TEST_CASE("surfaces and volumes have the colours of their cells, and PLY and OFF too") {
  const MadeDiagram surface = surface_diagram(25), solid = volume_diagram(25);
  for (const MadeDiagram* made : {&surface, &solid}) {
    const io::DiagramOutput output = coloured(*made, io::ColourBy::What::measure);
    const io::Model model = made == &surface ? io::surface_model(output) : io::volume_model(output);
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < made->weights.size(); ++i)
      if (made->measures.status[i] == SeedStatus::ok) {
        low = std::min(low, made->measures.mass[i]);
        high = std::max(high, made->measures.mass[i]);
      }
    for (const auto& triangle : model.triangles)
      CHECK(triangle.colour == io::scale_colour((made->measures.mass[triangle.part] - low) / (high - low)));
    TemporaryFolder folder;
    io::write_output(folder.file("d.off"), output);
    io::write_output(folder.file("h.off"), made->output());
    CHECK(read_all(folder.file("d.off")) != read_all(folder.file("h.off")));
  }
}
