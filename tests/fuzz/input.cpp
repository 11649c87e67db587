#include "tests/fuzz/input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace powercell::fuzz {
namespace {

using Limits = std::numeric_limits<double>;
constexpr double kHurtful[] = {Limits::quiet_NaN(),
                               Limits::infinity(),
                               -Limits::infinity(),
                               Limits::max(),
                               -Limits::max(),
                               Limits::min(),
                               Limits::denorm_min(),
                               -0.0,
                               1e9,
                               -1e9,
                               1e-6,
                               1e150,
                               1e-150,
                               0x1p53,
                               0x1p-53,
                               1e30};

/// Vertices on a coarse grid or anywhere, and indices that mostly exist.
void any_mesh(Input& input, std::size_t corners, DomainInput& mesh) {
  const std::size_t vertices = input.below(12), elements = input.below(10);
  mesh.vertices = input.numbers(3 * vertices + (input.below(32) == 31 ? 1 : 0));
  for (std::size_t k = 0; k < corners * elements; ++k)
    mesh.elements.push_back(static_cast<std::uint32_t>(input.below(vertices + 1)));
  if (!mesh.elements.empty() && input.below(64) == 63) mesh.elements.back() = 0xffffffff;
  if (!mesh.elements.empty() && input.below(64) == 63) mesh.elements.pop_back();
}

Ring any_ring(Input& input) {
  Ring ring(input.below(10));
  for (auto& point : ring)
    for (double& x : point) x = input.number();
  return ring;
}

Ring rectangle(double low, double high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}};
}

}  // namespace

std::uint8_t Input::byte() {
  return at_ < bytes_.size() ? bytes_[at_++] : std::uint8_t{0};
}

std::size_t Input::below(std::size_t count) {
  return byte() % count;
}

double Input::number() {
  const std::uint8_t what = byte();
  if (what < 208) return (what - 104) / 8.0;
  if (what < 224) {
    const double near = (byte() - 128) / 8.0;
    return near + (what - 216) * 0x1p-52 * std::max(1.0, std::fabs(near));
  }
  if (what < 240) {
    std::array<std::uint8_t, 8> bits;
    for (std::uint8_t& b : bits) b = byte();
    double value;
    std::memcpy(&value, bits.data(), sizeof value);
    return value;
  }
  return kHurtful[what - 240];
}

std::vector<double> Input::numbers(std::size_t count) {
  std::vector<double> values(count);
  for (double& value : values) value = number();
  return values;
}

DomainInput any_domain(Input& input) {
  DomainInput domain;
  domain.kind = static_cast<DomainInput::Kind>(input.below(4));
  switch (domain.kind) {
    case DomainInput::Kind::polygon:
      domain.parts.resize(input.below(4));
      for (PolygonPart& part : domain.parts) {
        part.outer = any_ring(input);
        part.holes.resize(input.below(3));
        for (Ring& hole : part.holes) hole = any_ring(input);
      }
      break;
    case DomainInput::Kind::surface:
      any_mesh(input, 3, domain);
      break;
    case DomainInput::Kind::volume:
      any_mesh(input, 4, domain);
      break;
    case DomainInput::Kind::box:
      domain.vertices = input.numbers(2 * input.below(5));
      break;
  }
  return domain;
}

/// A bar with teeth on both sides: pieces of it have corners in line.
template <class Place>
Ring comb(const Place& place) {
  Ring ring;
  const auto add = [&](double x, double y) { ring.push_back({place(x), place(y)}); };
  for (const auto& [x, y] :
       {std::pair{0, 0}, {1, 0}, {1, -1}, {2, -1}, {2, 0}, {3, 0}, {3, -1}, {4, -1}, {4, 0}})
    add(x / 4.0, y / 4.0);
  for (const auto& [x, y] : {std::pair{4, 1}, {4, 2}, {3, 2}, {3, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}})
    add(x / 4.0, y / 4.0);
  return ring;
}

DomainInput good_domain(Input& input) {
  DomainInput domain;
  const std::uint8_t what = input.byte();
  const std::size_t choice = what < 250 ? what % 5 : 5;
  constexpr double kScales[] = {1, 1, 1, 1e-6, 1e9}, kShifts[] = {0, 0, 0, 1e5, -1e9};
  const double scale = kScales[input.below(5)], shift = scale * kShifts[input.below(5)];
  const auto place = [&](double x) { return shift + scale * x; };
  if (choice <= 1) {
    const std::size_t d = 2 + choice;
    domain.vertices.assign(2 * d, place(0));
    std::fill(domain.vertices.begin() + static_cast<std::ptrdiff_t>(d), domain.vertices.end(), place(1));
  } else if (choice == 2) {
    domain.kind = DomainInput::Kind::polygon;
    domain.parts = {{rectangle(place(-1), place(2)), {rectangle(place(0), place(0.5))}}};
  } else if (choice == 5) {
    domain.kind = DomainInput::Kind::polygon;
    domain.parts = {{comb(place), {}}};
  } else if (choice == 3) {
    domain.kind = DomainInput::Kind::surface;
    domain.vertices = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    domain.elements = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    for (double& x : domain.vertices) x = place(x);
  } else {
    domain.kind = DomainInput::Kind::volume;
    domain.vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    domain.elements = {0, 1, 2, 3, 1, 2, 3, 4};
    for (double& x : domain.vertices) x = place(x);
  }
  return domain;
}

Domain make(const DomainInput& from) {
  switch (from.kind) {
    case DomainInput::Kind::polygon:
      return Domain::polygon(from.parts);
    case DomainInput::Kind::surface:
      return Domain::surface(from.vertices, from.elements);
    case DomainInput::Kind::volume:
      return Domain::volume(from.vertices, from.elements);
    default: {
      const std::span<const double> all = from.vertices;
      return Domain::box(all.first(all.size() / 2), all.subspan(all.size() / 2));
    }
  }
}

SeedInput any_seeds(Input& input, const Domain& domain, std::size_t count) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  const bool relative = input.byte() < 224;  // to the domain's box and size, or as they come
  const bool weighted = input.flag();
  const auto low = domain.low(), high = domain.high();
  double size = 0;
  for (std::size_t k = 0; k < d; ++k) size = std::max(size, high[k] - low[k]);
  SeedInput seeds{input.numbers(count * d), std::vector<double>(count, 0.0)};
  if (weighted) seeds.weights = input.numbers(count);
  if (!relative) return seeds;
  // Most small multiples of 1/8 then lie in the domain or next to it.
  for (std::size_t k = 0; k < seeds.positions.size(); ++k)
    seeds.positions[k] = low[k % d] + size * (0.5 + seeds.positions[k] / 8);
  for (double& weight : seeds.weights) weight *= size * size / 8;
  return seeds;
}

void require_readable(const std::string& message) {
  require(!message.empty(), "a refusal without a word");
  require(message.size() < 1000, "a message that fills the terminal: " + message);
  for (const char c : message) {
    const auto code = static_cast<unsigned char>(c);
    require(code >= ' ' && code != 0x7f, "a message with a control character: " + message);
  }
}

}  // namespace powercell::fuzz
