#include "apps/io/write/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/io/atomic_file.hpp"
#include "apps/io/picture/cairo.hpp"
#include "apps/io/picture/frame.hpp"
#include "apps/io/read/file.hpp"

namespace powercell::io {
namespace {

bool is_table(const std::string& extension) {
  return extension == ".csv" || extension == ".txt";
}
void write_rows(const std::string& path, const PointOutput& output, bool csv) {
  const auto d = static_cast<std::size_t>(output.domain.dimension());
  AtomicFile file(path);
  if (csv) {
    file.write(d == 3 ? "x,y,z,weight,mass" : "x,y,weight,mass");
    file.write(output.colours.empty() ? "\n" : ",r,g,b\n");
  }
  const char separator = csv ? ',' : ' ';
  for (std::size_t i = 0; i < output.weights.size(); ++i) {
    for (std::size_t k = 0; k < d; ++k) {
      file.number(output.positions[i * d + k]);
      file.write(separator);
    }
    file.number(output.weights[i]);
    if (csv) {
      file.write(separator);
      file.number(output.mass[i]);
      if (!output.colours.empty()) {
        const Colour& colour = output.colours[i];
        file.write(fmt::format(",{},{},{}", colour.red, colour.green, colour.blue));
      }
    }
    file.write('\n');
  }
  file.commit();
}

/// Dots in pixels, y downwards.
Scene scene_of(const PointOutput& output) {
  const auto low = output.domain.low(), high = output.domain.high();
  PictureFrame frame(output.size, {});
  const PictureRoom& room = frame.room();
  const double scale = std::min(room.width / (high[0] - low[0]), room.height / (high[1] - low[1]));
  frame.place(std::max(1.0, std::ceil((high[0] - low[0]) * scale - 1e-6)),
              std::max(1.0, std::ceil((high[1] - low[1]) * scale - 1e-6)));
  Scene scene;
  scene.width = frame.width();
  scene.height = frame.height();
  if (output.dark_paper) scene.paper = dark_paper;
  scene.units_per_inch = output.size.points ? 72 : 96;
  scene.title = fmt::format("{} points", output.weights.size());
  scene.description = "dots made by powercell sample";
  for (std::size_t i = 0; i < output.weights.size(); ++i)
    scene.discs.push_back({Scene::Mark::dot, static_cast<std::uint32_t>(i),
                           frame.left() + (output.positions[2 * i] - low[0]) * scale,
                           frame.top() + (high[1] - output.positions[2 * i + 1]) * scale,
                           output.radii[i] * scale, output.colours.empty() ? ink : output.colours[i]});
  return scene;
}

void write_svg_dots(const std::string& path, const Scene& scene) {
  AtomicFile file(path);
  file.write(fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\">\n"
      "<title>{2}</title>\n<desc>{3}</desc>\n<rect width=\"100%\" height=\"100%\" fill=\"{4}\"/>\n"
      "<g fill=\"{5}\">\n",
      scene.width, scene.height, scene.title, scene.description, hex(scene.paper), hex(ink)));
  for (const Scene::Disc& disc : scene.discs)
    file.write(fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"{}/>\n", disc.x, disc.y,
                           disc.radius,
                           disc.colour == ink ? "" : fmt::format(" fill=\"{}\"", hex(disc.colour))));
  file.write("</g>\n</svg>\n");
  file.commit();
}

}  // namespace

void check_points_format(const std::string& path) {
  check_extension(path, point_outputs);
}

void check_points(const std::string& path, const Domain& domain) {
  check_points_format(path);
  if (!is_table(lower_extension(path)) && domain.dimension() != 2)
    throw Error(
        ErrorCode::unsupported,
        path +
            ": pictures of dots need a polygon domain; write points in space as .csv or .txt, or write "
            "their cells");
}

void write_points(const std::string& path, const PointOutput& output) {
  check_points(path, output.domain);
  const std::string extension = lower_extension(path);
  if (is_table(extension)) return write_rows(path, output, extension == ".csv");
  const Scene scene = scene_of(output);
  if (extension == ".svg") return write_svg_dots(path, scene);
  if (extension == ".png") return draw_png(path, scene);
  draw_pdf(path, scene);
}

}  // namespace powercell::io
