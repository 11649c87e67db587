/// \file
/// Rows of fields, from a table or from the features of a map.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

using Fields = std::vector<std::string_view>;

class RowSource {
 public:
  virtual ~RowSource() = default;

  /// The next row with a field that is not empty; false at the end. Fields are valid until the next call.
  virtual bool next(Fields& fields) = 0;
  /// Called after the header, if there is one.
  virtual void begin_rows() {}
  /// What the rows are read from, for messages.
  virtual const std::string& name() const = 0;
  /// Of the last row, for messages: "s.csv:12", "s.geojson: feature 11 (from 0)".
  virtual std::string place() const = 0;
  /// Between columns; '\0' if the source is not a table.
  virtual char separator() const = 0;
  /// What the first columns, the coordinates x, y (, z), come from, if they come from geometries: "points",
  /// "POINT in 'geom'". Empty if they are columns of a table.
  virtual std::string geometry() const { return {}; }
  /// \throw Error invalid_file, always, with the place
  [[noreturn]] void fail(const std::string& what) const;
};

}  // namespace powercell::io
