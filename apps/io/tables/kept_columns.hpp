/// \file
/// The columns of the seeds' table that files of a diagram repeat.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/maps/frame.hpp"

namespace powercell::io {

struct KeptColumn {
  enum class Type { whole, real, text };  ///< by all its fields; empty ones are of any type
  std::size_t index = 0;                  ///< in the table
  std::string name;
  Type type = Type::text;
};

/// Every column of a table with a header, in its order. Results of an earlier run of the tool are left out,
/// since they are replaced. A column that is named like one of the results, or would be taken for its weights
/// when the file is read again, is called `input_NAME`.
class KeptColumns {
 public:
  /// \param results  names of the results in the same file
  KeptColumns(const InputView& inputs, const SeedsView& seeds,
              std::initializer_list<std::string_view> results);

  bool empty() const { return columns_.empty(); }
  const std::vector<KeptColumn>& columns() const& { return columns_; }
  // They would end with the object while a loop goes over them.
  void columns() const&& = delete;
  std::string_view field(std::size_t row, const KeptColumn& column) const;
  char mark() const { return table_ != nullptr ? table_->text.mark : '.'; }  ///< of decimals
  char separator() const { return table_ != nullptr ? table_->text.separator : ','; }
  /// Whether the coordinates, or the weights of `seeds`, are found in these columns when they are read again.
  bool has_positions() const { return positions_; }
  bool has_weights() const { return weights_; }

  /// A field of a column of numbers; not a number if it is empty.
  double number(std::size_t row, const KeptColumn& column) const;
  /// The values of a column of numbers; not a number for empty fields.
  std::vector<double> numbers(const KeptColumn& column) const;

 private:
  KeptColumn::Type type_of(std::size_t column) const;

  const SeedTable* table_ = nullptr;
  std::vector<KeptColumn> columns_;
  bool positions_ = false, weights_ = false;
};

}  // namespace powercell::io
