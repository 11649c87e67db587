#include "apps/io/read_seeds.hpp"

#include <fmt/format.h>

#include "apps/io/read_file.hpp"

namespace powercell::io {

bool is_random_spec(const std::string& spec) {
  return spec.starts_with("random:") || spec == "random";
}

SeedTable read_seeds(const std::string& spec, const Domain& domain) {
  if (is_random_spec(spec)) return random_seeds(parse_random_spec(spec), domain);
  const std::string extension = lower_extension(spec);
  if (extension == ".npz") fail_file(spec, "is an archive of arrays; save a single array as .npy");
  const std::string bytes = read_file(spec);
  if (extension == ".npy" || bytes.starts_with("\x93NUMPY"))
    return parse_seeds_npy(bytes, domain.dimension(), spec);
  return parse_seeds_text(bytes, domain.dimension(), spec);
}

}  // namespace powercell::io
