/// \file
/// The argument of --seeds: a table of seeds, or random ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <powercell/domain.hpp>
#include <powercell/seeds.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/tables/row_source.hpp"

namespace powercell::io {

/// The columns of a table of seeds as the user chooses them, each by a name in the header or a number from 1.
/// Those left empty are found by their names, else by their order.
struct ColumnChoice {
  std::array<std::string, 3> position;
  std::string weight;
  std::string radius;  ///< weights are the squares of this column
  std::string id;
  bool keeps_others = true;  ///< whether results repeat the other columns, for the note
  bool any() const;
  bool has_position() const;
};

/// The columns that were taken.
struct SeedColumns {
  std::size_t count = 0;           ///< columns of a row
  std::vector<std::string> names;  ///< as in the header; empty without one
  std::array<std::size_t, 3> position{0, 1, 2};
  std::optional<std::size_t> weight, id;
  bool named = false;    ///< the coordinates were found by their names
  bool radius = false;   ///< the weight is the square of its column
  bool degrees = false;  ///< the names of the coordinates say longitude and latitude
  std::string crs;       ///< that the file says; empty if it does not
  std::string taken;     ///< for messages: "x from 'lon', y from 'lat', no weights"
  std::string note;      ///< for a report: `taken` and the other columns, if the header leaves a doubt
};

/// The fields of a table with a header, as they are written in it.
class TableText {
 public:
  void add(std::string_view field);
  /// \pre the table has a header, row < rows()
  std::string_view field(std::size_t row, std::size_t column) const;

  std::size_t columns = 0;
  char separator = ',';
  char mark = '.';  ///< of decimals
  std::size_t rows() const { return columns == 0 ? 0 : ends_.size() / columns; }

 private:
  std::string bytes_;
  std::vector<std::size_t> ends_;  // rows x columns, row-major
};

struct SeedTable {
  int dimension = 0;              ///< coordinates of a seed: 2 or 3
  std::vector<double> positions;  ///< n x dimension, row-major, in the order of the file
  std::vector<double> weights;    ///< n, length^2
  bool scaled = false;            ///< the weights are not those of the table
  std::vector<double> given;  ///< n x dimension, if positions are projected: those of the input; else empty
  SeedColumns columns;        ///< of a table; else without any
  TableText text;             ///< of a table with a header; else empty
  std::size_t count() const { return weights.size(); }
  SeedsView view() const { return {dimension, positions, weights}; }
};

/// \param spec  text or CSV, `-` for those from standard input, points in GeoJSON or a GeoPackage, `.npy`, or
/// `random:N[:LO:HI[:SEED]]`
/// \param domain  sets the dimension of the seeds, and the positions of random ones
/// \throw Error invalid_file (file and line or row), invalid_seed (NaN or infinity), invalid_argument
SeedTable read_seeds(const std::string& spec, const Domain& domain, const ColumnChoice& choice = {});

/// The same of a file alone.
/// \param dimension  2 or 3
SeedTable read_seed_file(const std::string& path, int dimension, const ColumnChoice& choice);

/// Seeds from rows `x y [z] w`, or from the named columns below a header.
SeedTable parse_seed_rows(RowSource& rows, int dimension, const ColumnChoice& choice);

/// Text or CSV from memory with rows `x y [z] w`. Columns are separated as `number_separator` finds and
/// quoted as in RFC 4180; `#` begins a comment (below a header of separated columns only at the begin of a
/// line); rows of empty fields are skipped. The first line may be the number of rows, or a header: then the
/// columns of `choice`, or x, y (, z), or else longitude and latitude or easting and northing, and weight or
/// w are used in any order. Without a column of weights all weights are 0.
SeedTable parse_seeds_text(std::string_view text, int dimension, const std::string& name,
                           const ColumnChoice& choice = {});

/// NumPy's .npy from memory, versions 1 to 3: real or integer numbers, shape (n, d) or (n, d + 1).
SeedTable parse_seeds_npy(std::string_view bytes, int dimension, const std::string& name);

/// N, LO, HI, SEED of `random:N[:LO:HI[:SEED]]`.
struct RandomSeeds {
  std::uint64_t count = 0;
  double low = 0, high = 0;
  std::uint64_t seed = 1;
};
bool is_random_spec(const std::string& spec);
/// \throw Error invalid_argument
RandomSeeds parse_random_spec(const std::string& spec);

/// Seeds uniform in the domain's measure (on the surface itself), weights uniform in [low, high]. The same on
/// every machine: xoshiro256** seeded by splitmix64, see seeds_random.cpp.
SeedTable random_seeds(const RandomSeeds& seeds, const Domain& domain);

}  // namespace powercell::io
