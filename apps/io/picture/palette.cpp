#include "apps/io/picture/palette.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace powercell::io {
namespace {

constexpr std::array<Colour, 8> palette = {deep_blue, sky, teal, sand, amber, brick, mint, shell};

std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

// Removes the cell with the fewest remaining neighbours first. Coloured in reverse order, each cell has few
// coloured neighbours (at most five in the plane).
std::vector<std::uint32_t> smallest_last_order(const Adjacency& adjacency, std::size_t n) {
  std::vector<std::uint32_t> degree(n);
  std::uint32_t highest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    degree[i] = static_cast<std::uint32_t>(adjacency.offset[i + 1] - adjacency.offset[i]);
    highest = std::max(highest, degree[i]);
  }
  std::vector<std::vector<std::uint32_t>> bucket(highest + 1);
  for (std::size_t i = 0; i < n; ++i) bucket[degree[i]].push_back(static_cast<std::uint32_t>(i));
  std::vector<bool> removed(n);
  std::vector<std::uint32_t> order;
  order.reserve(n);
  for (std::size_t low = 0; order.size() < n;) {
    if (bucket[low].empty()) {
      ++low;
      continue;
    }
    const std::uint32_t i = bucket[low].back();
    bucket[low].pop_back();
    if (removed[i] || degree[i] != low) continue;  // an outdated entry; the cell is in another bucket
    removed[i] = true;
    order.push_back(i);
    for (std::uint64_t e = adjacency.offset[i]; e < adjacency.offset[i + 1]; ++e) {
      const std::uint32_t j = adjacency.neighbor[e];
      if (removed[j]) continue;
      bucket[--degree[j]].push_back(j);
      low = std::min<std::size_t>(low, degree[j]);
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

// The palette entry with the least common wall; among equals the one with the largest hash.
std::size_t choose(std::uint32_t seed, const std::array<double, palette.size()>& bordered) {
  std::size_t best = 0;
  std::uint32_t best_hash = 0;
  for (std::size_t c = 0; c < palette.size(); ++c) {
    const std::uint32_t here = hash(seed * 8u + static_cast<std::uint32_t>(c));
    if (c == 0 || bordered[c] < bordered[best] || (bordered[c] == bordered[best] && here > best_hash)) {
      best = c;
      best_hash = here;
    }
  }
  return best;
}

}  // namespace

double to_linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

double to_linear(std::uint8_t channel) {
  static const std::array<double, 256> linear = [] {
    std::array<double, 256> values{};
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = to_linear(static_cast<double>(k) / 255);
    return values;
  }();
  return linear[channel];
}

std::uint8_t to_srgb(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

std::string hex(Colour colour) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t c : {colour.red, colour.green, colour.blue}) {
    text += digits[c >> 4];
    text += digits[c & 15];
  }
  return text;
}

Colour mix(Colour colour, Colour other, double share) {
  const auto between = [share](std::uint8_t a, std::uint8_t b) { return channel(a + (b - a) * share); };
  return {between(colour.red, other.red), between(colour.green, other.green),
          between(colour.blue, other.blue)};
}

std::vector<Colour> cell_colours(const Adjacency& adjacency, std::size_t cells) {
  constexpr std::size_t none = palette.size();
  std::vector<std::size_t> chosen(cells, none);
  std::vector<std::uint32_t> order(cells);
  const bool known = adjacency.offset.size() == cells + 1;
  if (known)
    order = smallest_last_order(adjacency, cells);
  else
    std::iota(order.begin(), order.end(), 0u);
  for (const std::uint32_t i : order) {
    std::array<double, palette.size()> bordered{};
    for (std::uint64_t e = known ? adjacency.offset[i] : 0; known && e < adjacency.offset[i + 1]; ++e) {
      const std::size_t c = chosen[adjacency.neighbor[e]];
      if (c != none) bordered[c] += adjacency.wall[e];
    }
    chosen[i] = choose(i, bordered);
  }
  std::vector<Colour> colours(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const double shift = hash(static_cast<std::uint32_t>(i) ^ 0x5bd1e995u) / 4294967296.0 - 0.5;
    const Colour end = shift > 0 ? paper : ink;
    colours[i] = mix(palette[chosen[i]], end, std::abs(shift) * 0.22);
  }
  return colours;
}

}  // namespace powercell::io
