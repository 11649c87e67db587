/// \file
/// Seeds from points of maps with attributes.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/read/polygons.hpp"
#include "apps/io/tables/row_source.hpp"

namespace powercell::io {

/// The points of a file, in its order, as a table: columns x, y (, z), then the attributes.
class FeatureRows : public RowSource {
 public:
  /// \param attributes  their names; those called x, y or z get `input_` in front
  FeatureRows(std::string name, std::size_t dimension, const std::vector<std::string>& attributes);

  /// Adds a feature. The third coordinate is used if the dimension is 3.
  /// \throw Error invalid_file for coordinates that are not finite
  void add(const std::array<double, 3>& point, const std::vector<std::string>& attributes);

  bool next(Fields& fields) override;
  const std::string& name() const override { return name_; }
  std::string place() const override;
  char separator() const override { return '\0'; }
  std::string geometry() const override { return "points"; }
  std::size_t dimension() const { return dimension_; }
  std::size_t count() const { return fields_.size() / columns_ - 1; }

  NamedCrs crs;  ///< that the file says

 private:
  std::string name_;
  std::size_t dimension_, columns_;
  std::vector<std::string> fields_;  // header and features, row-major
  std::size_t row_ = 0;              // the next
};

/// FeatureCollection, Feature, GeometryCollection, Point, or MultiPoint with one point in GeoJSON. Attributes
/// are the properties, and the member `id` of features.
FeatureRows parse_geojson_points(std::string_view text, std::size_t dimension, const std::string& name);

}  // namespace powercell::io
