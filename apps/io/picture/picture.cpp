#include "apps/io/picture/picture.hpp"

#include <algorithm>

#include "apps/io/picture/cairo.hpp"
#include "apps/io/picture/colours.hpp"
#include "apps/io/picture/frame.hpp"
#include "apps/io/picture/models.hpp"
#include "apps/io/read/file.hpp"

namespace powercell::io {
namespace {

void write_image(const std::string& path, const Image& image) {
  write_pixels(path, {image.rgb, image.width, image.height}, {.width = image.width, .height = image.height});
}

// The model in perspective, with a legend.
void write_shaded(const std::string& path, const DiagramOutput& output, Model model) {
  PictureFrame frame(output.style.size, colouring_of(output).legend);
  const PictureRoom& room = frame.room();
  model.line_width *= static_cast<float>(frame.enlargement());
  const Image image = render(model, {.towards = output.style.towards,
                                     .up = output.style.up,
                                     .width = static_cast<int>(room.width),
                                     .height = static_cast<int>(room.height),
                                     .exact = room.exact});
  frame.place(image.width, image.height);
  write_pixels(path, {image.rgb, image.width, image.height},
               {.width = static_cast<int>(frame.width()),
                .height = static_cast<int>(frame.height()),
                .left = static_cast<int>(frame.left()),
                .top = static_cast<int>(frame.top()),
                .over = [&](cairo_t* to) { draw_legend(to, frame.legend()); }});
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
      return write_shaded(path, output, surface_model(output));
    case DomainKind::volume:
      return write_shaded(path, output, volume_model(output));
  }
}

bool is_picture(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".svg" || extension == ".png" || extension == ".pdf";
}

bool is_coloured(const std::string& path) {
  const std::string extension = lower_extension(path);
  return is_picture(path) || extension == ".ply" || extension == ".off" || extension == ".html";
}

void write_before_and_after(const std::string& path, const TriangleMesh& before, const TriangleMesh& after,
                            const PictureStyle& style) {
  const Normalization normalize = normalization(Domain::surface(before.vertices, before.triangles));
  const auto drawn = [&](const TriangleMesh& mesh, int width) {
    const bool exact = style.size.height > 0;
    Model model = mesh_model(mesh, normalize);
    model.line_width *= static_cast<float>(width) / 1100;
    return render(model, {style.towards, style.up, width, exact ? style.size.height : width, exact});
  };
  const int half = style.size.width / 2;
  const Image images[] = {drawn(before, half), drawn(after, style.size.width - half)};
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
