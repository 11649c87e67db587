#include "apps/io/tables/feature_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/io/read/file.hpp"
#include "apps/io/tables/fields.hpp"

namespace powercell::io {
namespace {

constexpr const char* coordinate_names[] = {"x", "y", "z"};

}  // namespace

FeatureRows::FeatureRows(std::string name, std::size_t dimension, const std::vector<std::string>& attributes)
    : name_(std::move(name)), dimension_(dimension), columns_(dimension + attributes.size()) {
  fields_.assign(coordinate_names, coordinate_names + dimension);
  std::set<std::string> used(fields_.begin(), fields_.end());
  for (std::string attribute : attributes) {
    if (used.count(column_name(attribute)) != 0) attribute.insert(0, "input_");
    while (!used.insert(column_name(attribute)).second) attribute += "_";
    fields_.push_back(std::move(attribute));
  }
}

void FeatureRows::add(const std::array<double, 3>& point, const std::vector<std::string>& attributes) {
  for (std::size_t k = 0; k < dimension_; ++k) {
    if (!std::isfinite(point[k]))
      fail_file(name_, fmt::format("feature {} (from 0): its {} is {}", count(), coordinate_names[k],
                                   std::isnan(point[k]) ? "missing or not a number" : "not finite"));
    fields_.push_back(fmt::format("{}", point[k]));
  }
  fields_.insert(fields_.end(), attributes.begin(), attributes.end());
}

bool FeatureRows::next(Fields& fields) {
  if (row_ * columns_ == fields_.size()) return false;
  const auto begin = fields_.begin() + static_cast<std::ptrdiff_t>(row_ * columns_);
  fields.assign(begin, begin + static_cast<std::ptrdiff_t>(columns_));
  ++row_;
  return true;
}

std::string FeatureRows::place() const {
  return row_ < 2 ? name_ : fmt::format("{}: feature {} (from 0)", name_, row_ - 2);
}

}  // namespace powercell::io
