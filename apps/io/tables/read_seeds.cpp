#include "apps/io/tables/read_seeds.hpp"

#include <fmt/format.h>

#include "apps/io/read/file.hpp"
#include "apps/io/read/foreign_files.hpp"
#include "apps/io/read/geopackage.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/tables/feature_rows.hpp"

namespace powercell::io {
namespace {

std::size_t axes(int dimension) {
  return static_cast<std::size_t>(dimension);
}

SeedTable seeds_of_features(FeatureRows rows, const ColumnChoice& choice) {
  SeedTable table = parse_seed_rows(rows, static_cast<int>(rows.dimension()), choice);
  table.columns.crs = rows.crs.name;
  return table;
}

}  // namespace

bool ColumnChoice::any() const {
  return has_position() || !(weight + radius + id).empty();
}

bool ColumnChoice::has_position() const {
  return !(position[0] + position[1] + position[2]).empty();
}

void TableText::add(std::string_view field) {
  bytes_ += field;
  ends_.push_back(bytes_.size());
}

std::string_view TableText::field(std::size_t row, std::size_t column) const {
  const std::size_t k = row * columns + column, begin = k == 0 ? 0 : ends_[k - 1];
  return std::string_view(bytes_).substr(begin, ends_[k] - begin);
}

bool is_random_spec(const std::string& spec) {
  return spec.starts_with("random:") || spec == "random";
}

SeedTable read_seeds(const std::string& spec, const Domain& domain, const ColumnChoice& choice) {
  if (!is_random_spec(spec)) return read_seed_file(spec, domain.dimension(), choice);
  if (choice.any())
    throw Error(ErrorCode::invalid_argument,
                spec + ": random seeds have no columns to choose; leave those options out");
  return random_seeds(parse_random_spec(spec), domain);
}

SeedTable read_seed_file(const std::string& path, int dimension, const ColumnChoice& choice) {
  const bool is_stream = path == "-";
  const std::string name = is_stream ? "standard input" : path, extension = lower_extension(path);
  if (is_geopackage(path)) return seeds_of_features(read_geopackage_points(path, axes(dimension)), choice);
  if (extension == ".npz") fail_file(path, "is an archive of arrays; save a single array as .npy");
  refuse_foreign_map(extension, name);
  const std::string bytes = read_file(is_stream ? "/dev/stdin" : path);
  if (extension == ".geojson" || extension == ".json" || trimmed(bytes.substr(0, 64)).starts_with('{'))
    return seeds_of_features(parse_geojson_points(bytes, axes(dimension), name), choice);
  if (extension != ".npy" && !bytes.starts_with("\x93NUMPY"))
    return parse_seeds_text(bytes, dimension, name, choice);
  if (choice.any())
    fail_file(path,
              "columns of an array are taken by their order; save the columns x, y (, z), weight alone");
  return parse_seeds_npy(bytes, dimension, name);
}

}  // namespace powercell::io
