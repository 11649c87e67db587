/// \file
/// Seeds from a column of points in well-known text.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "apps/io/read/polygons.hpp"
#include "apps/io/tables/row_source.hpp"

namespace powercell::io {

/// Whether a text begins as a point, or points, with `SRID=n;` in front or not.
bool begins_as_wkt_point(std::string_view text);

/// A table whose header names no coordinates and whose first row has a field POINT (x y [z]), after `SRID=n;`
/// or not: its coordinates come first, as columns x, y (, z). Without a header, a table of that column alone.
/// Other tables are passed on as they are.
class WktColumn : public RowSource {
 public:
  /// \param rows  outlives this
  WktColumn(RowSource& rows, std::size_t dimension);
  ~WktColumn() override;

  bool next(Fields& fields) override;
  const std::string& name() const override { return rows_.name(); }
  std::string place() const override;
  char separator() const override { return rows_.separator(); }
  std::string geometry() const override { return geometry_; }
  /// That of the points, by their SRID.
  const NamedCrs& crs() const { return crs_; }

 private:
  class Parser;
  struct Row {
    std::vector<std::string> fields;
    std::string place;
  };
  bool read_ahead();
  void find_column();
  void add_coordinates(Fields& fields);

  RowSource& rows_;
  std::size_t dimension_;
  std::vector<Row> ahead_;  // the first rows
  std::size_t passed_ = 0;  // how many of them were passed on
  std::size_t column_ = 0;
  std::string geometry_;
  std::array<std::string, 3> coordinates_;  // of the last row
  NamedCrs crs_;
  std::unique_ptr<Parser> parser_;
};

}  // namespace powercell::io
