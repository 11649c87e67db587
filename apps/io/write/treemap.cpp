#include "apps/io/write/treemap.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/picture/treemap_scene.hpp"
#include "apps/io/read/file.hpp"

namespace powercell::io {
namespace {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void write_corner(AtomicFile& file, const double* point) {
  file.write('[');
  file.number(point[0]);
  file.write(',');
  file.number(point[1]);
  file.write(']');
}

void write_json(const std::string& path, const TreemapOutput& output) {
  const Treemap& map = output.map;
  AtomicFile file(path);
  file.write("[\n");
  bool first = true;
  for (std::size_t i = 0; i < output.tree.size(); ++i) {
    if (map.kind[i] == TreeNode::dropped) continue;
    if (!first) file.write(",\n");
    first = false;
    const std::int64_t parent = output.tree.parent[i];
    file.write(fmt::format("{{\"id\":{},\"parent\":{},\"name\":{},\"value\":", quoted(output.tree.id[i]),
                           parent < 0 ? "null" : quoted(output.tree.id[static_cast<std::size_t>(parent)]),
                           quoted(output.tree.name[i])));
    file.number(map.value[i]);
    if (output.hue[i] >= 0) file.write(fmt::format(",\"hue\":{}", output.hue[i]));
    if (output.shade[i] >= 0) file.write(fmt::format(",\"shade\":{}", output.shade[i]));
    file.write(",\"seed\":");
    write_corner(file, &map.seeds[2 * i]);
    file.write(",\"polygon\":[");
    for (std::uint64_t v = map.vertex_offset[i]; v < map.vertex_offset[i + 1]; ++v) {
      if (v > map.vertex_offset[i]) file.write(',');
      write_corner(file, &map.vertices[2 * v]);
    }
    file.write("]}");
  }
  file.write("\n]\n");
  file.commit();
}

}  // namespace

void check_treemap_output(const std::string& path) {
  check_extension(path, treemap_outputs);
}

void write_treemap(const std::string& path, const TreemapOutput& output, const TreemapStyle& style) {
  check_treemap_output(path);
  const std::string extension = lower_extension(path);
  if (extension == ".json") return write_json(path, output);
  const TreemapScene scene = make_treemap_scene(output, style);
  if (extension == ".svg") return draw_treemap_svg(path, scene, output);
  if (extension == ".png") return draw_treemap_png(path, scene);
  draw_treemap_pdf(path, scene);
}

}  // namespace powercell::io
