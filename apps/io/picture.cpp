#include "apps/io/picture.hpp"

#include "apps/io/picture_cairo.hpp"
#include "apps/io/picture_solid.hpp"

namespace powercell::io {

void write_pdf(const std::string& path, const DiagramOutput& output) {
  draw_pdf(path, make_scene(output));
}

void write_png(const std::string& path, const DiagramOutput& output) {
  switch (output.domain.kind()) {
    case DomainKind::polygon:
      return draw_png(path, make_scene(output));
    case DomainKind::surface:
      return draw_surface(path, output);
    case DomainKind::volume:
      return draw_volume(path, output);
  }
}

}  // namespace powercell::io
