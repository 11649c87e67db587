#include "apps/treemap_shape.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <powercell/shapes.hpp>
#include <string_view>

#include "apps/io/read_domain.hpp"
#include "apps/io/read_text.hpp"

namespace powercell::app {
namespace {

std::optional<Ring> rectangle(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string::npos) return std::nullopt;
  double width = 0, height = 0;
  const std::string_view text = spec;
  if (io::parse_number(text.substr(0, colon), width) != io::Parsed::ok ||
      io::parse_number(text.substr(colon + 1), height) != io::Parsed::ok)
    return std::nullopt;
  if (!(width > 0) || !(height > 0))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("--shape {}: width and height must be above 0", spec));
  return Ring{{0, 0}, {width, 0}, {width, height}, {0, height}};
}

std::optional<Ring> circle(const std::string& spec) {
  if (spec == "circle") return disk(256);
  constexpr std::string_view prefix = "circle:";
  if (spec.compare(0, prefix.size(), prefix) != 0) return std::nullopt;
  int corners = 0;
  const char* end = spec.data() + spec.size();
  const auto [stop, error] = std::from_chars(spec.data() + prefix.size(), end, corners);
  if (error != std::errc() || stop != end || corners < 3 || corners > 10000)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("--shape {}: a circle has 3 to 10000 corners", spec));
  return disk(corners);
}

}  // namespace

Ring treemap_shape(const std::string& spec) {
  if (const auto ring = rectangle(spec)) return *ring;
  if (const auto ring = circle(spec)) return *ring;
  if (spec == "hexagon") return disk(6);
  const io::LoadedDomain loaded = io::read_domain(spec);
  if (loaded.domain.kind() != DomainKind::polygon)
    throw Error(ErrorCode::invalid_domain, fmt::format("{}: the shape of a treemap must be a polygon", spec));
  if (loaded.parts.size() != 1 || !loaded.parts.front().holes.empty())
    throw Error(
        ErrorCode::invalid_domain,
        fmt::format("{}: {} parts, {} holes; a treemap needs one convex polygon", spec, loaded.parts.size(),
                    loaded.parts.empty() ? 0 : loaded.parts.front().holes.size()));
  return loaded.parts.front().outer;
}

}  // namespace powercell::app
