// The built-in shapes of --domain.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <powercell/shapes.hpp>

#include "apps/io/read/domain.hpp"
#include "apps/io/read/domain_box.hpp"

namespace powercell::io {
namespace {

struct Builtin {
  const char* name;
  int resolution;   // default; 0 if the shape has no resolution
  int least, most;  // range of resolutions
};
constexpr Builtin builtins[] = {{"square", 0, 0, 0},  {"cube", 0, 0, 0},       {"disk", 256, 3, 1000000},
                                {"ball", 10, 1, 256}, {"sphere", 32, 1, 4096}, {"torus", 48, 3, 4096}};

const Builtin* find(const std::string& spec) {
  const std::string name = spec.substr(0, spec.find(':'));
  for (const Builtin& builtin : builtins) {
    if (name == builtin.name) return &builtin;
  }
  return nullptr;
}

int resolution(const Builtin& builtin, const std::string& spec) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string::npos) return builtin.resolution;
  const char *begin = spec.data() + colon + 1, *end = spec.data() + spec.size();
  int value = 0;
  const auto [stop, code] = std::from_chars(begin, end, value);
  if (builtin.resolution == 0) {
    throw Error(ErrorCode::invalid_argument,
                fmt::format("domain {}: {} takes no resolution", spec, builtin.name));
  }
  if (code != std::errc() || stop != end || value < builtin.least || value > builtin.most) {
    throw Error(ErrorCode::invalid_argument,
                fmt::format("domain {}: the resolution is not a whole number from {} to {}", spec,
                            builtin.least, builtin.most));
  }
  return value;
}

}  // namespace

bool is_builtin_domain(const std::string& spec) {
  return find(spec) != nullptr || is_box_spec(spec);
}

std::vector<std::string> builtin_domain_names() {
  std::vector<std::string> names;
  for (const Builtin& builtin : builtins) names.emplace_back(builtin.name);
  names.insert(names.end(), {"box:", "lattice:"});
  return names;
}

DomainArrays builtin_domain(const std::string& spec) {
  if (is_box_spec(spec)) return parse_box(spec);
  const Builtin* builtin = find(spec);
  if (builtin == nullptr)
    throw Error(ErrorCode::invalid_argument, fmt::format("domain {} is not a built-in shape", spec));
  const int n = resolution(*builtin, spec);
  const std::string name = builtin->name;
  if (name == "square") return parse_box("box:0,0:1,1");
  if (name == "cube") return parse_box("box:0,0,0:1,1,1");
  if (name == "disk") return {DomainKind::polygon, {{disk(n), {}}}, {}, {}};
  if (name == "ball") {
    TetrahedralMesh mesh = ball(n);
    return {DomainKind::volume, {}, std::move(mesh.vertices), std::move(mesh.tetrahedra)};
  }
  TriangleMesh mesh = name == "sphere" ? sphere(n) : torus(n);
  return {DomainKind::surface, {}, std::move(mesh.vertices), std::move(mesh.triangles)};
}

}  // namespace powercell::io
