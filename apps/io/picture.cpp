#include "apps/io/picture.hpp"

#include <algorithm>

#include "apps/io/picture_cairo.hpp"
#include "apps/io/picture_models.hpp"

namespace powercell::io {
namespace {

void write_image(const std::string& path, const Image& image) {
  write_pixels(path, image.rgb, image.width, image.height);
}

}  // namespace

void write_pdf(const std::string& path, const DiagramOutput& output) {
  draw_pdf(path, make_scene(output));
}

void write_png(const std::string& path, const DiagramOutput& output) {
  switch (output.domain.kind()) {
    case DomainKind::polygon:
      return draw_png(path, make_scene(output));
    case DomainKind::surface:
      return write_image(path, render(surface_model(output)));
    case DomainKind::volume:
      return write_image(path, render(volume_model(output)));
  }
}

void write_before_and_after(const std::string& path, const TriangleMesh& before, const TriangleMesh& after) {
  const Normalization normalize = normalization(Domain::surface(before.vertices, before.triangles));
  const View view{.size = 1100};
  const Image images[] = {render(mesh_model(before, normalize), view),
                          render(mesh_model(after, normalize), view)};
  Image both{images[0].width + images[1].width, std::max(images[0].height, images[1].height), {}};
  for (int y = 0; y < both.height; ++y)
    for (const Image& image : images) {
      const int row = y - (both.height - image.height) / 2;
      const auto width = 3 * static_cast<std::ptrdiff_t>(image.width);
      if (row < 0 || row >= image.height)
        both.rgb.insert(both.rgb.end(), static_cast<std::size_t>(width), 255);
      else
        both.rgb.insert(both.rgb.end(), image.rgb.begin() + row * width,
                        image.rgb.begin() + (row + 1) * width);
    }
  write_image(path, both);
}

}  // namespace powercell::io
