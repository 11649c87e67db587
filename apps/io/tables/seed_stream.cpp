#include "apps/io/tables/seed_stream.hpp"

#include <array>
#include <powercell/error.hpp>

#include "apps/io/read/file.hpp"
#include "apps/io/read/geopackage.hpp"

namespace powercell::io {
namespace {

constexpr std::uint64_t rows_at_once = std::uint64_t{1} << 16;

/// \throw Error for what is not read some rows at a time
const std::string& streamable(const std::string& path, const ColumnChoice& choice,
                              const std::string& otherwise) {
  if (is_random_spec(path))
    throw Error(ErrorCode::invalid_argument,
                path + ": random seeds are made in memory; " + otherwise + ", or save seeds in a file");
  const std::string extension = lower_extension(path);
  if (path == "-" || is_geopackage(path) || extension == ".geojson" || extension == ".json" ||
      extension == ".npz")
    fail_file(path, "is not read piece by piece, as an .npy or a CSV is; save its seeds so, or " + otherwise);
  if (!choice.id.empty())
    throw Error(ErrorCode::invalid_argument,
                path + ": ids are kept in memory; leave --id-column out and name seeds by their index, or " +
                    otherwise);
  return path;
}

}  // namespace

SeedStream::SeedStream(const std::string& path, int dimension, const ColumnChoice& choice,
                       const std::string& otherwise)
    : path_(streamable(path, choice, otherwise)), dimension_(dimension), choice_(choice), file_(path) {
  choice_.keeps_others = false;
  for (const std::string& column :
       {choice.position[0], choice.position[1], choice.position[2], choice.weight, choice.radius})
    choice_name_ += ", " + column;
  if (file_.bytes().starts_with("\x93NUMPY")) {
    if (choice.any())
      fail_file(path,
                "columns of an array are taken by their order; save the columns x, y (, z), weight alone");
    array_.emplace(file_.bytes(), dimension, path);
    count_ = array_->rows();
    return;
  }
  begin_text();
  std::array<double, 3> position{};
  for (double weight = 0; text_->next(position.data(), weight); ++count_)
    if (count_ % rows_at_once == 0) file_.drop();
  columns_ = text_->columns();
  begin_text();
}

void SeedStream::begin_text() {
  text_ = std::make_unique<SeedText>(file_.bytes(), dimension_, path_, choice_);
  text_next_ = 0;
}

void SeedStream::read(std::uint64_t first, std::span<double> positions, std::span<double> weights) {
  if (array_) {
    array_->read(first, positions, weights);
  } else {
    if (text_next_ > first) begin_text();
    std::array<double, 3> passed{};
    for (double weight = 0; text_next_ < first; ++text_next_) text_->next(passed.data(), weight);
    const auto d = static_cast<std::size_t>(dimension_);
    for (std::size_t k = 0; k < weights.size(); ++k, ++text_next_)
      if (!text_->next(&positions[k * d], weights[k])) fail_file(path_, "was cut off while it was read");
  }
  file_.drop();
}

void SeedStream::require_unchanged() const {
  if (stamp_of(path_) != file_.stamp())
    fail_file(path_, "was changed while its cells were computed; run it again");
}

}  // namespace powercell::io
