#include "apps/io/tables/seed_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/io/tables/column_units.hpp"

namespace powercell::io {
namespace {

constexpr std::string_view centroid_names[] = {"cx", "cy", "cz"};

}  // namespace

void FieldWriter::separate() {
  if (!first_) file_.write(separator_);
  first_ = false;
}

void FieldWriter::text(std::string_view field) {
  separate();
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  const bool quote = field.find_first_of("\"\n\r#") != std::string_view::npos ||
                     field.find(separator_) != std::string_view::npos ||
                     (!field.empty() && (blank(field.front()) || blank(field.back()))) ||
                     (field.empty() && separator_ == ' ');
  if (!quote) {
    file_.write(field);
    return;
  }
  file_.write('"');
  for (const char c : field) {
    if (c == '"') file_.write('"');
    file_.write(c);
  }
  file_.write('"');
}

void FieldWriter::number(double value) {
  if (!std::isfinite(value)) return empty();
  separate();
  if (mark_ == '.') return file_.number(value);
  std::string text = fmt::format("{}", value);
  std::replace(text.begin(), text.end(), '.', mark_);
  file_.write(text);
}

void FieldWriter::count(std::uint64_t value) {
  separate();
  file_.number(value);
}

void FieldWriter::end_row() {
  file_.write('\n');
  first_ = true;
}

SeedRows::SeedRows(const std::string& path, const SeedsView& seeds, const InputView& inputs,
                   std::initializer_list<std::string_view> results)
    : seeds_(seeds),
      inputs_(inputs),
      dimension_(static_cast<std::size_t>(seeds.dimension)),
      kept_(inputs, seeds,
            {"seed", "status", "measure", "mass", "target", "cx", "cy", "cz", "second_moment", "neighbors",
             "merged_with"}),
      fields_(path, kept_.separator(), kept_.mark()) {
  for (const KeptColumn& column : kept_.columns()) fields_.text(column.name);
  fields_.text("seed");
  for (std::size_t k = 0; k < dimension_ && !kept_.has_positions(); ++k) fields_.text(axis_names[k]);
  if (!kept_.has_weights()) fields_.text("weight");
  for (const std::string_view result : results) {
    if (result != "centroid") fields_.text(result);
    for (std::size_t k = 0; k < dimension_ && result == "centroid"; ++k) fields_.text(centroid_names[k]);
  }
  fields_.end_row();
}

void SeedRows::begin(std::size_t seed) {
  for (const KeptColumn& column : kept_.columns()) fields_.text(kept_.field(seed, column));
  fields_.count(seed);
  const double* given = inputs_.positions(seeds_) + (seed - first_) * dimension_;
  for (std::size_t k = 0; k < dimension_ && !kept_.has_positions(); ++k) fields_.number(given[k]);
  if (!kept_.has_weights()) fields_.number(seeds_.weights.empty() ? 0.0 : seeds_.weights[seed - first_]);
}

void SeedRows::point(const double* point) {
  std::array<double, 3> shown{};
  std::copy(point, point + dimension_, shown.begin());
  if (const MapPlane* plane = inputs_.plane(); plane != nullptr && std::isfinite(point[0])) {
    const MapPoint map = plane->rounded(plane->to_map({point[0], point[1]}));
    std::copy(map.begin(), map.end(), shown.begin());
  }
  for (std::size_t k = 0; k < dimension_; ++k) fields_.number(shown[k]);
}

}  // namespace powercell::io
