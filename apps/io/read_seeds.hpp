/// \file
/// The argument of --seeds: a table of seeds, or random ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <powercell/domain.hpp>
#include <powercell/seeds.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

struct SeedTable {
  int dimension = 0;              ///< coordinates of a seed: 2 or 3
  std::vector<double> positions;  ///< n x dimension, row-major, in the order of the file
  std::vector<double> weights;    ///< n, length^2
  std::string note;               ///< for a report: which columns of a table were used
  std::size_t count() const { return weights.size(); }
  SeedsView view() const { return {dimension, positions, weights}; }
};

/// \param spec  text or CSV, `.npy`, or `random:N[:LO:HI[:SEED]]`
/// \param domain  sets the dimension of the seeds, and the positions of random ones
/// \throw Error invalid_file (file and line or row), invalid_seed (NaN or infinity), invalid_argument
SeedTable read_seeds(const std::string& spec, const Domain& domain);

/// Text or CSV from memory with rows `x y [z] w`. Columns are separated as `number_separator` finds and
/// quoted as in RFC 4180; `#` begins a comment; rows of empty fields are skipped. The first line may be the
/// number of rows, or a header: then the columns x, y (, z), or else longitude and latitude or easting and
/// northing, and weight or w are used in any order, and other columns ignored. Without a column of weights
/// all weights are 0.
SeedTable parse_seeds_text(std::string_view text, int dimension, const std::string& name);

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
