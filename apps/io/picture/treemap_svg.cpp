#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/io/atomic_file.hpp"
#include "apps/io/picture/text.hpp"
#include "apps/io/picture/treemap_scene.hpp"
#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

constexpr std::size_t deepest_group = 100;  // XML readers refuse deeper nesting

// Rounded to a thousandth of a pixel, without trailing zeros.
void append(std::string& text, double pixels) {
  const long long thousandths = std::llround(pixels * 1000);
  fmt::format_to(std::back_inserter(text), "{}", thousandths / 1000);
  long long rest = std::llabs(thousandths % 1000);
  if (rest == 0) return;
  std::string digits = fmt::format("{:03}", rest);
  while (digits.back() == '0') digits.pop_back();
  text += '.' + digits;
}

class Drawing {
 public:
  Drawing(const std::string& path, const TreemapScene& scene, const TreemapOutput& output)
      : file_(path), scene_(scene), output_(output) {}

  void write() {
    file_.write(fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.6g} {1:.6g}\" width=\"{0:.6g}\" "
        "height=\"{1:.6g}\">\n<title>{2}</title>\n<desc>{3}</desc>\n"
        "<style>path{{stroke-linejoin:round;stroke:{4}}}.g{{fill:none}}"
        "text{{font-family:{7};text-anchor:middle;dominant-baseline:central;"
        "fill:{5};pointer-events:none}}.l{{fill:{4}}}.b{{font-weight:bold;paint-order:stroke;stroke:{4};"
        "stroke-opacity:{6:.3g}}}"
        "path:hover{{fill-opacity:.75}}</style>\n",
        scene_.width, scene_.height, xml_text(scene_.title), xml_text(scene_.description), hex(paper),
        hex(ink), halo_opacity, font_families));
    if (std::any_of(scene_.cells.begin(), scene_.cells.end(), [](const auto& cell) { return cell.striped; }))
      file_.write(stripes_svg(scene_.stripes));
    for (std::size_t k = 0; k < scene_.cells.size(); ++k) {
      close_up_to(k);
      const TreemapScene::Cell& cell = scene_.cells[k];
      if (cell.leaf) {
        path(cell);
      } else {
        if (open_.size() < deepest_group)
          file_.write(fmt::format("<g id=\"group-{}\">{}\n", cell.node, title(cell)));
        open_.push_back(k);
      }
    }
    close_up_to(scene_.cells.size() + 1);
    labels();
    file_.write(legend_svg(scene_.legend));
    file_.write("</svg>\n");
    file_.commit();
  }

 private:
  std::string title(const TreemapScene::Cell& cell) const {
    return fmt::format("<title>{}: {:.6g}</title>", xml_text(printable(output_.tree.name[cell.node])),
                       output_.map.value[cell.node]);
  }

  // Whether it has the outline of the group around it, as an only child has.
  bool fills(const TreemapScene::Cell& cell, const TreemapScene::Cell& around) const {
    const auto at = [&](std::uint64_t v) {
      return scene_.points.begin() + static_cast<std::ptrdiff_t>(2 * v);
    };
    return std::equal(at(cell.first), at(cell.end), at(around.first), at(around.end));
  }

  // The wall of a group is drawn over its children: those that fill it need none of their own.
  void close_up_to(std::size_t k) {
    while (!open_.empty() && k > open_.back() + scene_.below[open_.back()]) {
      const TreemapScene::Cell& group = scene_.cells[open_.back()];
      open_.pop_back();
      if (open_.empty() || !fills(group, scene_.cells[open_.back()])) path(group);
      if (open_.size() < deepest_group) file_.write("</g>\n");
    }
  }

  void path(const TreemapScene::Cell& cell) {
    text_ = "<path ";
    if (cell.leaf)
      text_ += fmt::format("data-id=\"{}\" fill=\"{}\"", xml_text(printable(output_.tree.id[cell.node])),
                           cell.striped ? "url(#no-value)" : hex(cell.fill));
    else
      text_ += fmt::format("class=\"g\" data-id=\"{}\"", xml_text(printable(output_.tree.id[cell.node])));
    text_ += fmt::format(" stroke-width=\"{:.3g}\" d=\"", cell.wall);
    for (std::uint64_t v = cell.first; v < cell.end; ++v) {
      text_ += v == cell.first ? 'M' : 'L';
      append(text_, scene_.points[2 * v]);
      text_ += ' ';
      append(text_, scene_.points[2 * v + 1]);
    }
    text_ += cell.leaf ? fmt::format("z\">{}</path>\n", title(cell)) : "z\"/>\n";
    file_.write(text_);
  }

  // textLength keeps a text in its cell with any font.
  void labels() {
    for (const TreemapScene::Label& label : scene_.labels) {
      text_ = label.bold ? fmt::format("<text class=\"b\" stroke-width=\"{:.3g}\"", label_halo * label.size)
                         : (label.light ? "<text class=\"l\"" : "<text");
      file_.write(fmt::format(
          "{} x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.3g}\" textLength=\"{:.2f}\" opacity=\"{:.2g}\">{}"
          "</text>\n",
          text_, label.x, label.y, label.size, label.width, label.opacity, xml_text(label.text)));
    }
  }

  AtomicFile file_;
  const TreemapScene& scene_;
  const TreemapOutput& output_;
  std::vector<std::size_t> open_;  // groups begun, by their place among the cells
  std::string text_;
};

}  // namespace

void draw_treemap_svg(const std::string& path, const TreemapScene& scene, const TreemapOutput& output) {
  Drawing(path, scene, output).write();
}

}  // namespace powercell::io
