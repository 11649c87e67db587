#include <fmt/format.h>

#include <cmath>

#include "apps/io/atomic_file.hpp"
#include "apps/io/picture/picture.hpp"
#include "apps/io/picture/scene.hpp"
#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

// A hundredth of a pixel is finer than any screen. Whole hundredths keep the file small, and their
// differences add up without drift.
std::int64_t hundredths(double pixels) {
  return std::llround(pixels * 100);
}

void append(std::string& text, std::int64_t hundredths, bool separate) {
  if (hundredths < 0)
    text += '-';
  else if (separate)
    text += ' ';
  const std::int64_t size = std::abs(hundredths);
  const std::int64_t whole = size / 100, rest = size % 100;
  if (whole > 0 || rest == 0) fmt::format_to(std::back_inserter(text), "{}", whole);
  if (rest == 0) return;
  text += '.';
  text += static_cast<char>('0' + rest / 10);
  if (rest % 10 > 0) text += static_cast<char>('0' + rest % 10);
}

void append_rings(std::string& text, const Scene::Rings& rings, std::uint64_t first, std::uint64_t end) {
  for (std::uint64_t r = first; r < end; ++r) {
    std::int64_t x = 0, y = 0;
    for (std::uint64_t v = rings.offset[r]; v < rings.offset[r + 1]; ++v) {
      const bool start = v == rings.offset[r];
      const std::int64_t next_x = hundredths(rings.points[2 * v]),
                         next_y = hundredths(rings.points[2 * v + 1]);
      if (!start && next_x == x && next_y == y) continue;
      text += start ? "M" : "l";
      append(text, next_x - x, false);
      append(text, next_y - y, true);
      x = next_x;
      y = next_y;
    }
    text += 'z';
  }
}

std::string style(const Scene& scene) {
  return fmt::format(
      "<style>.cells{{fill-rule:evenodd;stroke:{1};stroke-width:{2:.3g};stroke-linejoin:round}}"
      ".outline{{fill:none;stroke:{0};stroke-width:{3:.3g};stroke-linejoin:round}}"
      ".positive{{fill:{0};fill-opacity:.13;stroke:{0};stroke-opacity:.65;stroke-width:{4:.3g}}}"
      ".negative{{fill:none;stroke:{0};stroke-opacity:.75;stroke-width:{4:.3g};stroke-dasharray:{5:.3g}}}"
      ".dot{{fill:{0}}}.hidden{{fill:{1};stroke:{0};stroke-width:{4:.3g}}}"
      ".duplicate{{fill:none;stroke:{0};stroke-width:{4:.3g}}}</style>\n",
      hex(ink), hex(paper), scene.wall_width, scene.outline_width, scene.disc_line, 3.5 * scene.disc_line);
}

const char* class_of(Scene::Mark mark) {
  switch (mark) {
    case Scene::Mark::dot:
      return "dot";
    case Scene::Mark::positive:
      return "positive";
    case Scene::Mark::negative:
      return "negative";
    case Scene::Mark::hidden:
      return "hidden";
    case Scene::Mark::duplicate:
      return "duplicate";
  }
  return "";
}

void write_discs(AtomicFile& file, const Scene& scene) {
  file.write("<g pointer-events=\"none\">\n");
  for (const Scene::Disc& disc : scene.discs) {
    if (disc.mark == Scene::Mark::duplicate) {
      file.write(
          fmt::format("<path class=\"duplicate\" data-seed=\"{0}\" d=\"M{1:.2f} {2:.2f}l{3:.2f} {3:.2f}"
                      "m0-{3:.2f}l-{3:.2f} {3:.2f}\"/>\n",
                      disc.seed, disc.x - disc.radius, disc.y - disc.radius, 2 * disc.radius));
      continue;
    }
    file.write(
        fmt::format("<circle class=\"{}\" data-seed=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n",
                    class_of(disc.mark), disc.seed, disc.x, disc.y, disc.radius));
  }
  file.write("</g>\n");
}

}  // namespace

void write_svg(const std::string& path, const DiagramOutput& output) {
  const Scene scene = make_scene(output);
  AtomicFile file(path);
  file.write(
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
                  "width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\">\n"
                  "<title>{2}</title>\n<desc>{3}</desc>\n",
                  scene.width, scene.height, xml_text(scene.title), xml_text(scene.description)));
  file.write(style(scene));
  if (scene.has_stripes) file.write(stripes_svg(scene.stripes));
  file.write(
      fmt::format("<rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n<g class=\"cells\">\n", hex(paper)));
  for (const Scene::Cell& cell : scene.cells) {
    std::string text = fmt::format("<path id=\"cell-{0}\" data-seed=\"{0}\" fill=\"{1}\" d=\"", cell.seed,
                                   cell.striped ? "url(#no-value)" : hex(cell.fill));
    append_rings(text, scene.cell_rings, cell.first_ring, cell.end_ring);
    if (cell.label.empty())
      text += "\"/>\n";
    else
      text += "\"><title>" + xml_text(cell.label) + "</title></path>\n";
    file.write(text);
  }
  std::string outline = "</g>\n<path class=\"outline\" d=\"";
  append_rings(outline, scene.outline, 0, scene.outline.size());
  file.write(outline + "\"/>\n");
  write_discs(file, scene);
  file.write(legend_svg(scene.legend));
  file.write("</svg>\n");
  file.commit();
}

}  // namespace powercell::io
