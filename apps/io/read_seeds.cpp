#include "apps/io/read_seeds.hpp"

#include <fmt/format.h>

#include "apps/io/read_file.hpp"

namespace powercell::io {

bool ColumnChoice::any() const {
  return !(position[0] + position[1] + position[2] + weight + radius + id).empty();
}

void TableText::add(std::string_view field) {
  bytes_ += field;
  ends_.push_back(bytes_.size());
}

std::string_view TableText::field(std::size_t row, std::size_t column) const {
  const std::size_t k = row * columns + column, begin = k == 0 ? 0 : ends_[k - 1];
  return std::string_view(bytes_).substr(begin, ends_[k] - begin);
}

bool is_random_spec(const std::string& spec) {
  return spec.starts_with("random:") || spec == "random";
}

SeedTable read_seeds(const std::string& spec, const Domain& domain, const ColumnChoice& choice) {
  if (!is_random_spec(spec)) return read_seed_file(spec, domain.dimension(), choice);
  if (choice.any())
    throw Error(ErrorCode::invalid_argument,
                spec + ": random seeds have no columns to choose; leave those options out");
  return random_seeds(parse_random_spec(spec), domain);
}

SeedTable read_seed_file(const std::string& path, int dimension, const ColumnChoice& choice) {
  if (path == "-") return parse_seeds_text(read_file("/dev/stdin"), dimension, "standard input", choice);
  const std::string extension = lower_extension(path);
  if (extension == ".npz") fail_file(path, "is an archive of arrays; save a single array as .npy");
  const std::string bytes = read_file(path);
  if (extension != ".npy" && !bytes.starts_with("\x93NUMPY"))
    return parse_seeds_text(bytes, dimension, path, choice);
  if (choice.any())
    fail_file(path,
              "columns of an array are taken by their order; save the columns x, y (, z), weight alone");
  return parse_seeds_npy(bytes, dimension, path);
}

}  // namespace powercell::io
