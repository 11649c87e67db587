/// \file
/// Seeds of a text, one after the other.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "apps/io/tables/read_seeds.hpp"

namespace powercell::io {

/// As parse_seeds_text() reads them, without the fields of their rows.
class SeedText {
 public:
  /// \param text  not copied; nor is the choice
  /// \throw Error invalid_file
  SeedText(std::string_view text, int dimension, const std::string& name, const ColumnChoice& choice);
  ~SeedText();

  /// Reads the next seed.
  /// \param position  as many coordinates as the dimension says
  /// \return whether there is one
  /// \throw Error as parse_seeds_text()
  bool next(double* position, double& weight);
  /// Those that the last seed was read from.
  SeedColumns columns() const;

  struct Rows;

 private:
  std::unique_ptr<Rows> rows_;
};

}  // namespace powercell::io
