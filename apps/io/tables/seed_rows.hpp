/// \file
/// Tables with a row for each seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "apps/io/atomic_file.hpp"
#include "apps/io/tables/kept_columns.hpp"

namespace powercell::io {

/// Separates and quotes fields as RFC 4180 has it, so that they are read back the same.
class FieldWriter {
 public:
  /// \param mark  of decimals
  FieldWriter(const std::string& path, char separator, char mark = '.')
      : file_(path), separator_(separator), mark_(mark) {}

  void text(std::string_view field);
  void number(double value);  ///< empty if it is not finite
  void count(std::uint64_t value);
  void empty() { text({}); }
  void end_row();
  /// \throw Error write_failed
  void commit() { file_.commit(); }

 private:
  void separate();
  AtomicFile file_;
  char separator_, mark_;
  bool first_ = true;
};

/// Writes `seed,x,y[,z],weight` and results. If the seeds come from a table with a header, its columns come
/// first, as they are in it, with its separator; then x, y, z and weight are left out where a reader finds
/// them in those.
class SeedRows {
 public:
  /// Writes the header.
  /// \param results  names of the columns after the weight; "centroid" stands for cx,cy[,cz]
  SeedRows(const std::string& path, const SeedsView& seeds, const InputView& inputs,
           std::initializer_list<std::string_view> results);

  /// Rows are of these seeds from here on, of which the first one has the index `first`.
  void use(const SeedsView& seeds, std::size_t first) { seeds_ = seeds, first_ = first; }
  void begin(std::size_t seed);
  /// A point of the plane, in the coordinates of the inputs.
  void point(const double* point);
  FieldWriter& fields() { return fields_; }
  void commit() { fields_.commit(); }

 private:
  SeedsView seeds_;
  InputView inputs_;
  std::size_t first_ = 0;
  std::size_t dimension_;
  KeptColumns kept_;
  FieldWriter fields_;
};

}  // namespace powercell::io
