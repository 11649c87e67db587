#include "apps/io/read/density.hpp"

#include <fmt/format.h>

#include "apps/io/read/file.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

std::vector<double> vertex_values(const std::string& path) {
  const std::string text = read_file(path);
  TextScanner scanner(text, path);
  std::vector<double> values;
  while (!scanner.at_end()) values.push_back(scanner.number({"value of vertex", values.size()}));
  return values;
}

}  // namespace

Density read_density(const std::string& spec, const Domain& domain) {
  double value = 0;
  if (parse_number(spec, value) == Parsed::ok) return Density::constant(value);
  const std::string extension = lower_extension(spec);
  if (extension == ".txt" || extension == ".csv") {
    if (domain.kind() == DomainKind::polygon)
      throw Error(
          ErrorCode::unsupported,
          fmt::format("{}: values at vertices need a surface or volume; for a polygon give a formula", spec));
    return Density::nodal(vertex_values(spec));
  }
  return Density::formula(spec);
}

}  // namespace powercell::io
