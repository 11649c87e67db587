#include "apps/io/page/data.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <powercell/error.hpp>
#include <powercell/version.hpp>
#include <span>

#include "apps/io/base64.hpp"
#include "apps/io/names.hpp"
#include "apps/io/page/mesh.hpp"
#include "apps/io/picture/colour_scales.hpp"
#include "apps/io/picture/palette.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/tables/kept_columns.hpp"

namespace powercell::io {
namespace {

using nlohmann::json;

std::string varints(std::span<const std::int32_t> values) {
  std::string bytes;
  std::int64_t before = 0;
  for (const std::int32_t value : values) {
    const std::int64_t step = value - before;
    before = value;
    auto code = static_cast<std::uint64_t>(step >= 0 ? 2 * step : -2 * step - 1);
    for (; code >= 128; code >>= 7) bytes += static_cast<char>((code & 127) | 128);
    bytes += static_cast<char>(code);
  }
  return bytes;
}

/// Arrays with their names, in the order in which they were added.
class Arrays {
 public:
  template <class T>
  void add(const std::string& name, std::span<const T> values) {
    const char* type = std::is_same_v<T, float>    ? "float32"
                       : std::is_same_v<T, double> ? "float64"
                       : std::is_signed_v<T>       ? "int8"
                                                   : "uint8";
    add(name, type, values.size(), {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  void integers(const std::string& name, std::span<const std::int32_t> values) {
    add(name, "integers", values.size(), varints(values));
  }

  const json& described() const { return described_; }
  void write(AtomicFile& file) const {
    for (const auto& [name, bytes] : packed_) {
      file.write("<script type=\"text/plain\" id=\"array-" + name + "\">");
      write_base64(file, bytes);
      file.write("</script>\n");
    }
  }

 private:
  void add(const std::string& name, const char* type, std::size_t count, std::string_view bytes) {
    described_[name] = {{"type", type}, {"count", count}};
    std::string packed(compressBound(bytes.size()), '\0');
    uLongf size = packed.size();
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6) != Z_OK)
      throw Error(ErrorCode::write_failed, "zlib could not compress the array " + name);
    packed.resize(size);
    packed_.emplace_back(name, std::move(packed));
  }

  json described_ = json::object();
  std::vector<std::pair<std::string, std::string>> packed_;
};

template <class T>
std::span<const T> view_of(const std::vector<T>& values) {
  return values;
}

void require_drawable(const ViewMesh& mesh, const std::string& path) {
  const std::size_t points = mesh.points.size() / static_cast<std::size_t>(mesh.dimension);
  const std::size_t most = std::max({mesh.triangles(), points, mesh.sizes.size()});
  if (most <= most_in_view) return;
  throw Error(
      ErrorCode::unsupported,
      path + ": the cells have " + with_commas(most) + " triangles or points, and browsers draw at most " +
          with_commas(most_in_view) +
          "; write .vtu or .vtp for other programs, .png for a picture, or take fewer seeds or a coarser "
          "domain");
}

void add_mesh(Arrays& arrays, const ViewMesh& mesh) {
  arrays.add("points", view_of(mesh.points));
  if (!mesh.normals.empty()) arrays.add("normals", view_of(mesh.normals));
  arrays.integers("corners", mesh.corners);
  arrays.integers("sizes", mesh.sizes);
  arrays.integers("inner", mesh.inner);
  if (!mesh.outer.empty()) arrays.integers("outer", mesh.outer);
}

void add_results(Arrays& arrays, const DiagramOutput& output) {
  const std::size_t n = output.seeds.size();
  const Measures& measures = output.measures;
  std::vector<std::uint8_t> colours, status;
  for (const Colour& colour : cell_colours(output.adjacency, n))
    colours.insert(colours.end(), {colour.red, colour.green, colour.blue});
  for (const SeedStatus s : measures.status) status.push_back(static_cast<std::uint8_t>(s));
  std::vector<double> weights(output.seeds.weights.begin(), output.seeds.weights.end());
  weights.resize(n, 0.0);
  std::vector<std::int32_t> neighbors(n, 0);
  for (std::size_t i = 0; i < n && i + 1 < output.adjacency.offset.size(); ++i)
    neighbors[i] = static_cast<std::int32_t>(output.adjacency.offset[i + 1] - output.adjacency.offset[i]);
  arrays.add("cell_colours", view_of(colours));
  arrays.add("position", std::span<const double>(output.seeds.positions));
  arrays.add("weight", view_of(weights));
  arrays.add("status", view_of(status));
  arrays.add("measure", view_of(measures.mass));
  arrays.add("centroid", view_of(measures.centroid));
  arrays.add("second_moment", view_of(measures.second_moment));
  arrays.integers("neighbors", neighbors);
}

/// Indices of the different texts of a column, in the order in which they first occur.
std::vector<std::int32_t> classes_of(const KeptColumns& kept, const KeptColumn& column, std::size_t rows,
                                     json& values) {
  std::map<std::string_view, std::int32_t> known;
  std::vector<std::int32_t> indices;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::string_view field = kept.field(row, column);
    const auto [found, is_new] = known.emplace(field, static_cast<std::int32_t>(known.size()));
    if (is_new) values.push_back(std::string(field));
    indices.push_back(found->second);
  }
  return indices;
}

/// The table's columns, with their names in the page.
KeptColumns page_columns(const DiagramOutput& output) {
  return {output.inputs,
          output.seeds,
          {"seed", "position", "weight", "status", "measure", "centroid", "second_moment", "neighbors"}};
}

/// Whether the page colours by this column at first.
bool is_chosen(const KeptColumn& column, const ColourBy& colours) {
  return colours.what == ColourBy::What::column && colours.column.index == column.index;
}

json add_columns(Arrays& arrays, const DiagramOutput& output) {
  const KeptColumns kept = page_columns(output);
  json described = json::array();
  for (const KeptColumn& column : kept.columns()) {
    const SeedColumns& taken = output.inputs.table->columns;
    bool known = kept.has_weights() && taken.weight == column.index;
    for (int k = 0; kept.has_positions() && output.inputs.plane() == nullptr && k < output.seeds.dimension;
         ++k)
      known = known || taken.position[static_cast<std::size_t>(k)] == column.index;
    if (known && !is_chosen(column, output.style.colours)) continue;
    const std::string name = "column" + std::to_string(described.size());
    json entry = {{"name", column.name}};
    if (column.type == KeptColumn::Type::text) {
      json values = json::array();
      arrays.integers(name, classes_of(kept, column, output.seeds.size(), values));
      entry["type"] = "text";
      entry["values"] = std::move(values);
    } else {
      arrays.add(name, view_of(kept.numbers(column)));
      entry["type"] = "number";
    }
    described.push_back(std::move(entry));
  }
  return described;
}

/// Within an element of HTML, where "</script>" and "<!--" would have a meaning.
std::string embedded(const json& value) {
  std::string text;
  for (const char c : value.dump(-1, ' ', false, json::error_handler_t::replace))
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

constexpr int steps_of_scale = 256;

/// What the page colours by at first; empty for colours that tell cells apart.
std::string colour_name(const DiagramOutput& output) {
  const ColourBy& colours = output.style.colours;
  switch (colours.what) {
    case ColourBy::What::measure:
      return "measure";
    case ColourBy::What::weight:
      return "weight";
    case ColourBy::What::neighbors:
      return "neighbors";
    case ColourBy::What::column: {
      const KeptColumns kept = page_columns(output);
      for (const KeptColumn& column : kept.columns())
        if (is_chosen(column, colours)) return column.name;
      break;
    }
    case ColourBy::What::hues:
      break;
  }
  return {};
}

}  // namespace

void write_view_data(AtomicFile& file, const DiagramOutput& output, const std::string& title,
                     const std::string& path) {
  if (std::endian::native != std::endian::little)
    throw Error(ErrorCode::unsupported, path + ": pages are written on little-endian machines; use .vtu");
  const ViewMesh mesh = view_mesh(output);
  require_drawable(mesh, path);
  const Measures& measures = output.measures;
  Arrays arrays;
  add_mesh(arrays, mesh);
  add_results(arrays, output);
  json diagram = {{"powercell", version()},
                  {"title", title},
                  {"kind", name(output.domain.kind())},
                  {"dimension", output.domain.dimension()},
                  {"seeds", output.seeds.size()},
                  {"check",
                   {{"cells", measures.count(SeedStatus::ok)},
                    {"hidden", measures.count(SeedStatus::hidden)},
                    {"duplicate", measures.count(SeedStatus::duplicate)},
                    {"measure", measures.total()},
                    {"domain_measure", measures.domain_measure}}},
                  {"frame", {{"offset", mesh.offset}, {"scale", mesh.scale}}}};
  if (const MapPlane* plane = output.inputs.plane()) diagram["map"] = plane->definition();
  diagram["columns"] = add_columns(arrays, output);
  for (int k = 0; k < steps_of_scale; ++k)
    diagram["scale"].push_back(hex(scale_colour(k / (steps_of_scale - 1.0))));
  for (const Colour& colour : class_colours(most_classes)) diagram["palette"].push_back(hex(colour));
  if (const std::string colour = colour_name(output); !colour.empty()) diagram["colour"] = colour;
  diagram["arrays"] = arrays.described();
  file.write("<script type=\"application/json\" id=\"diagram\">" + embedded(diagram) + "</script>\n");
  arrays.write(file);
}

}  // namespace powercell::io
