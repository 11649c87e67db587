#include "apps/io/picture/cairo.hpp"

#include <cairo-pdf.h>
#include <cairo.h>

#include <cmath>
#include <exception>
#include <memory>
#include <powercell/error.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/picture/legend.hpp"

namespace powercell::io {
namespace {

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextDeleter {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;
using Context = std::unique_ptr<cairo_t, ContextDeleter>;

// Receives cairo's output and writes it to a file. Exceptions must not pass through cairo's C frames.
struct Sink {
  AtomicFile file;
  std::exception_ptr error;

  static cairo_status_t write(void* self, const unsigned char* data, unsigned int length) {
    auto* sink = static_cast<Sink*>(self);
    if (sink->error) return CAIRO_STATUS_WRITE_ERROR;
    try {
      sink->file.write({reinterpret_cast<const char*>(data), length});
      return CAIRO_STATUS_SUCCESS;
    } catch (...) {
      sink->error = std::current_exception();
      return CAIRO_STATUS_WRITE_ERROR;
    }
  }
  void commit(const std::string& path, cairo_status_t status) {
    if (error) std::rethrow_exception(error);
    if (status != CAIRO_STATUS_SUCCESS) {
      throw Error(ErrorCode::write_failed, path + ": cairo: " + cairo_status_to_string(status));
    }
    file.commit();
  }
};

void add_rings(cairo_t* to, const Scene::Rings& rings, std::uint64_t first, std::uint64_t end) {
  for (std::uint64_t r = first; r < end; ++r) {
    for (std::uint64_t v = rings.offset[r]; v < rings.offset[r + 1]; ++v) {
      cairo_line_to(to, rings.points[2 * v], rings.points[2 * v + 1]);
    }
    cairo_close_path(to);
    cairo_new_sub_path(to);
  }
}

void draw_disc(cairo_t* to, const Scene& scene, const Scene::Disc& disc) {
  cairo_new_path(to);
  if (disc.mark == Scene::Mark::duplicate) {
    cairo_move_to(to, disc.x - disc.radius, disc.y - disc.radius);
    cairo_line_to(to, disc.x + disc.radius, disc.y + disc.radius);
    cairo_move_to(to, disc.x + disc.radius, disc.y - disc.radius);
    cairo_line_to(to, disc.x - disc.radius, disc.y + disc.radius);
  } else {
    cairo_arc(to, disc.x, disc.y, disc.radius, 0, 2 * std::acos(-1.0));
  }
  cairo_set_line_width(to, scene.disc_line);
  const double dash = 3.5 * scene.disc_line;
  cairo_set_dash(to, &dash, disc.mark == Scene::Mark::negative ? 1 : 0, 0);
  switch (disc.mark) {
    case Scene::Mark::dot:
      set_colour(to, disc.colour);
      cairo_fill(to);
      return;
    case Scene::Mark::positive:
      set_colour(to, ink, 0.13);
      cairo_fill_preserve(to);
      set_colour(to, ink, 0.65);
      break;
    case Scene::Mark::hidden:
      set_colour(to, paper);
      cairo_fill_preserve(to);
      set_colour(to, ink);
      break;
    case Scene::Mark::negative:
      set_colour(to, ink, 0.75);
      break;
    case Scene::Mark::duplicate:
      set_colour(to, ink);
      break;
  }
  cairo_stroke(to);
}

void draw(cairo_t* to, const Scene& scene) {
  set_colour(to, scene.paper);
  cairo_paint(to);
  cairo_set_line_join(to, CAIRO_LINE_JOIN_ROUND);
  cairo_set_fill_rule(to, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_set_line_width(to, scene.wall_width);
  for (const Scene::Cell& cell : scene.cells) {
    cairo_new_path(to);
    add_rings(to, scene.cell_rings, cell.first_ring, cell.end_ring);
    if (cell.striped) {
      fill_striped(to, scene.stripes);
    } else {
      set_colour(to, cell.fill);
      cairo_fill_preserve(to);
    }
    set_colour(to, paper);
    if (scene.wall_width > 0) cairo_stroke(to);
  }
  cairo_new_path(to);
  add_rings(to, scene.outline, 0, scene.outline.size());
  set_colour(to, ink);
  cairo_set_line_width(to, scene.outline_width);
  cairo_stroke(to);
  for (const Scene::Disc& disc : scene.discs) draw_disc(to, scene, disc);
  draw_legend(to, scene.legend);
}

void write_image(const std::string& path, cairo_surface_t* image) {
  Sink sink{AtomicFile(path), {}};
  const cairo_status_t status = cairo_surface_write_to_png_stream(image, Sink::write, &sink);
  sink.commit(path, status);
}

}  // namespace

void set_colour(cairo_t* to, Colour colour, double opacity) {
  cairo_set_source_rgba(to, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0, opacity);
}

void paint_png(const std::string& path, double width, double height, const Painter& paint) {
  const Surface image(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height)));
  const Context context(cairo_create(image.get()));
  paint(context.get());
  if (cairo_status(context.get()) != CAIRO_STATUS_SUCCESS) {
    throw Error(ErrorCode::write_failed,
                path + ": cairo: " + cairo_status_to_string(cairo_status(context.get())));
  }
  write_image(path, image.get());
}

void paint_pdf(const std::string& path, double width, double height, const PageText& text,
               const Painter& paint, double units_per_inch) {
  Sink sink{AtomicFile(path), {}};
  const double scale = 72 / units_per_inch;  // a PDF's unit is 1/72 inch
  const Surface page(cairo_pdf_surface_create_for_stream(Sink::write, &sink, width * scale, height * scale));
  cairo_pdf_surface_set_metadata(page.get(), CAIRO_PDF_METADATA_TITLE, text.title.c_str());
  cairo_pdf_surface_set_metadata(page.get(), CAIRO_PDF_METADATA_SUBJECT, text.description.c_str());
  const Context context(cairo_create(page.get()));
  cairo_scale(context.get(), scale, scale);
  paint(context.get());
  const cairo_status_t drawn = cairo_status(context.get());
  cairo_surface_finish(page.get());
  sink.commit(path, drawn != CAIRO_STATUS_SUCCESS ? drawn : cairo_surface_status(page.get()));
}

void draw_png(const std::string& path, const Scene& scene) {
  paint_png(path, scene.width, scene.height, [&](cairo_t* to) { draw(to, scene); });
}

void draw_pdf(const std::string& path, const Scene& scene) {
  paint_pdf(
      path, scene.width, scene.height, {scene.title, scene.description},
      [&](cairo_t* to) { draw(to, scene); }, scene.units_per_inch);
}

void write_pixels(const std::string& path, const Pixels& pixels, const PixelCanvas& canvas) {
  const Surface image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, canvas.width, canvas.height));
  unsigned char* data = cairo_image_surface_get_data(image.get());
  const int stride = cairo_image_surface_get_stride(image.get());
  if (!data) throw Error(ErrorCode::write_failed, path + ": no memory for a picture of that size");
  const Context context(cairo_create(image.get()));
  set_colour(context.get(), paper);
  cairo_paint(context.get());
  cairo_surface_flush(image.get());
  for (int y = 0; y < pixels.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t{y + canvas.top} * stride);
    const std::uint8_t* p =
        &pixels.rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels.width) * 3];
    for (int x = 0; x < pixels.width; ++x, p += 3)
      row[x + canvas.left] = static_cast<std::uint32_t>(p[0] << 16 | p[1] << 8 | p[2]);
  }
  cairo_surface_mark_dirty(image.get());
  if (canvas.over) canvas.over(context.get());
  write_image(path, image.get());
}

}  // namespace powercell::io
