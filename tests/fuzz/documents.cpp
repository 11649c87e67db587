// Readers of trees, tables, JSON and pictures.
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <powercell/treemap.hpp>
#include <set>
#include <string>
#include <string_view>

#include "apps/bench/saved_record.hpp"
#include "apps/io/read/image.hpp"
#include "apps/io/tables/read_masses.hpp"
#include "apps/io/tables/read_tree.hpp"
#include "apps/saved.hpp"
#include "tests/fuzz/refusals.hpp"
#include "tests/fuzz/treemap_laws.hpp"

namespace powercell::fuzz {
namespace {

const std::string kName = "file";

void check_tree(const io::NamedTree& tree) {
  const std::size_t n = tree.size();
  require(n > 0 && tree.name.size() == n && tree.parent.size() == n && tree.value.size() == n,
          "a tree whose arrays differ in length");
  require(tree.row.empty() || tree.row.size() == n, "rows of another number than nodes");
  require(std::set<std::string>(tree.id.begin(), tree.id.end()).size() == n, "an id twice");
  require(std::ranges::count(tree.parent, -1) == 1, "not one root");
  for (std::size_t i = 0; i < n; ++i) {
    require(std::isfinite(tree.value[i]), "a value that is not finite");
    require_readable(tree.called(i));
    std::size_t steps = 0;
    for (std::int64_t at = static_cast<std::int64_t>(i); at >= 0;
         at = tree.parent[static_cast<std::size_t>(at)])
      require(at < static_cast<std::int64_t>(n) && ++steps <= n, "a parent out of range, or a cycle");
  }
}

void lay_out(const io::NamedTree& tree, std::span<const double> start) {
  TreemapOptions options;
  options.rounds = 2;
  options.threads = 1;
  options.start = start;
  options.name = [&](std::size_t node) { return tree.called(node); };
  const Treemap map = treemap({tree.parent, tree.value}, {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, options);
  check_treemap(map, tree.parent, options.tolerance);
}

void check_layout(const io::EarlierLayout& layout, const io::NamedTree& tree) {
  const std::size_t n = tree.size();
  require(layout.parent.size() == n && layout.seeds.size() == 2 * n && layout.vertex_offset.size() == n + 1,
          "a layout of another size than its tree");
  require(layout.vertex_offset.front() == 0 && std::ranges::is_sorted(layout.vertex_offset) &&
              2 * layout.vertex_offset.back() == layout.vertices.size(),
          "offsets of the layout do not fit");
  require(layout.known <= n, "more known nodes than nodes");
}

/// A changed chunk of a PNG has the sum of its old bytes, and the rest would never be read: gives each its
/// own.
std::string with_sums(std::string_view png) {
  std::string bytes(png);
  const auto at = [&](std::size_t k) { return static_cast<unsigned char>(bytes[k]); };
  for (std::size_t chunk = 8; chunk + 12 <= bytes.size();) {
    const std::size_t length =
        (std::size_t{at(chunk)} << 24) | (at(chunk + 1) << 16) | (at(chunk + 2) << 8) | at(chunk + 3);
    const std::size_t end = chunk + 8 + length;
    if (end + 4 > bytes.size()) break;
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + chunk + 4, static_cast<uInt>(length + 4));
    for (std::size_t k = 0; k < 4; ++k) bytes[end + k] = static_cast<char>(sum >> (24 - 8 * k));
    chunk = end + 4;
  }
  return bytes;
}

void check_image(const io::GrayImage& image) {
  require(image.width > 0 && image.height > 0 && image.values.size() == image.width * image.height,
          "a picture without pixels, or of another number");
  for (const double value : image.values)
    require(value >= -1e-12 && value <= 1 + 1e-12, "light that is not between 0 and 1");
}

void check_saved_diagram(std::string_view bytes) {
  const app::SavedFile file = app::parse_saved(bytes, kName);
  if (file.cells.loop.size() > 2000) return;
  for (const LawCheck& law : app::check_saved(file, Precision::float64, {20, 1}))
    if (!law.passed) require_readable(law.law + ": " + law.detail);
}

}  // namespace

void trees(Bytes input) {
  if (input.empty()) return;
  const std::string_view bytes(reinterpret_cast<const char*>(input.data()) + 1, input.size() - 1);
  const std::size_t format = input[0] % 3;
  const auto codes = {ErrorCode::invalid_file, ErrorCode::invalid_argument};
  accepted(codes, [&] {
    const io::NamedTree tree = io::parse_tree(bytes, format == 0 ? ".csv" : ".json", kName);
    check_tree(tree);
    std::vector<double> start;
    if (format == 2) {
      const io::EarlierLayout layout = io::parse_earlier_layout(bytes, tree, kName);
      check_layout(layout, tree);
      start = relative_positions(layout.parent, layout.seeds, layout.vertex_offset, layout.vertices);
    }
    if (tree.size() <= 60) lay_out(tree, start);
  });
}

void documents(Bytes input) {
  if (input.empty()) return;
  const std::string_view bytes(reinterpret_cast<const char*>(input.data()) + 1, input.size() - 1);
  const std::size_t choice = input[0] % 8;
  accepted({ErrorCode::invalid_file, ErrorCode::invalid_argument}, [&] {
    if (choice == 0) {
      const std::size_t rows = 1 + static_cast<std::size_t>(std::ranges::count(bytes, '\n'));
      for (const double mass : io::parse_masses(bytes, "", rows > 2 ? rows - 1 : 1, kName))
        require(mass > 0 && std::isfinite(mass), "a mass that is not positive");
    } else if (choice == 1) {
      io::parse_masses(bytes, "area", 2, kName);
    } else if (choice <= 3) {
      check_saved_diagram(bytes);
    } else if (choice == 4) {
      for (const app::SavedRow& row : app::parse_record(bytes, kName).rows)
        require(row.n > 0 && row.rate >= 0 && row.adjacency_rate >= 0,
                "a row of no seeds or a negative rate");
    } else {
      check_image(io::parse_image(choice == 6 ? with_sums(bytes) : std::string(bytes), kName));
    }
  });
}

}  // namespace powercell::fuzz
