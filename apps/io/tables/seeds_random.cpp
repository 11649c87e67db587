// Random seeds that are the same on every machine: a generator with a fixed definition, followed only by
// additions, multiplications and comparisons of doubles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <powercell/regions.hpp>
#include <powercell/seeds.hpp>

#include "apps/io/printable.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/tables/read_seeds.hpp"

namespace powercell::io {
namespace {

// xoshiro256** 1.0, seeded by splitmix64 (D. Blackman and S. Vigna, "Scrambled linear pseudorandom number
// generators", ACM TOMS 47 (2021)).
class Generator {
 public:
  explicit Generator(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {
      seed += 0x9e3779b97f4a7c15u;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      word = z ^ (z >> 31);
    }
  }
  /// Uniform in [0, 1): the upper 53 bits over 2^53.
  double next() {
    const auto rotated = [](std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); };
    const std::uint64_t result = rotated(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotated(state_[3], 45);
    return static_cast<double>(result >> 11) * 0x1p-53;
  }

 private:
  std::array<std::uint64_t, 4> state_;
};

using Vec = std::array<double, 3>;

Vec vertex(const RegionsView& mesh, std::uint32_t index) {
  Vec p{};
  for (int axis = 0; axis < mesh.dimension; ++axis)
    p[axis] = mesh.vertices[std::size_t{index} * mesh.dimension + axis];
  return p;
}

Vec minus(const Vec& a, const Vec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The domain's regions as simplices (or boxes), with the running sum of their measures.
struct Pieces {
  std::vector<std::array<std::uint32_t, 4>> corners;  // triangle: 3; tetrahedron: 4; box: corners 0 1 2 4
  std::vector<double> sum;                            // of the measures up to each, inclusive

  void add(const std::array<std::uint32_t, 4>& piece, double measure) {
    corners.push_back(piece);
    sum.push_back((sum.empty() ? 0.0 : sum.back()) + measure);
  }
};

Pieces pieces_of(const RegionsView& mesh) {
  Pieces pieces;
  for (std::size_t region = 0; region < mesh.size(); ++region) {
    const std::uint32_t* v = mesh.region_vertex.data() + mesh.region_offset[region];
    const std::size_t n = mesh.region_offset[region + 1] - mesh.region_offset[region];
    const Vec origin = vertex(mesh, v[0]);
    const auto edge = [&](std::size_t k) { return minus(vertex(mesh, v[k]), origin); };
    if (mesh.shape == RegionShape::polygon) {
      for (std::size_t k = 2; k < n; ++k) {
        const Vec normal = cross(edge(k - 1), edge(k));
        pieces.add({v[0], v[k - 1], v[k], 0}, std::sqrt(dot(normal, normal)));
      }
    } else if (mesh.shape == RegionShape::tetrahedron) {
      pieces.add({v[0], v[1], v[2], v[3]}, std::abs(dot(edge(3), cross(edge(1), edge(2)))));
    } else {
      pieces.add({v[0], v[1], v[2], v[4]}, std::abs(dot(edge(4), cross(edge(1), edge(2)))));
    }
  }
  return pieces;
}

// Folds a uniform point of the unit cube into the simplex u, v, w >= 0, u + v + w <= 1 by volume-preserving
// maps, so that it stays uniform (C. Rocchini and P. Cignoni, J. Graphics Tools 5 (2000) 9-12).
void fold_into_tetrahedron(double& u, double& v, double& w) {
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  if (v + w > 1) {
    const double old = w;
    w = 1 - u - v;
    v = 1 - old;
  } else if (u + v + w > 1) {
    const double old = w;
    w = u + v + w - 1;
    u = 1 - v - old;
  }
}

// A point of a piece: its first corner plus fractions of the edges from there.
Vec point_in(const RegionsView& mesh, const std::array<std::uint32_t, 4>& corners, Generator& generator) {
  double u = generator.next(), v = generator.next(), w = 0;
  if (mesh.cell_dimension == 3) w = generator.next();
  if (mesh.shape == RegionShape::polygon && u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  if (mesh.shape == RegionShape::tetrahedron) fold_into_tetrahedron(u, v, w);
  const Vec origin = vertex(mesh, corners[0]);
  const Vec a = minus(vertex(mesh, corners[1]), origin), b = minus(vertex(mesh, corners[2]), origin);
  Vec c{};
  if (mesh.cell_dimension == 3) c = minus(vertex(mesh, corners[3]), origin);
  Vec p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = origin[axis] + (u * a[axis] + v * b[axis] + w * c[axis]);
  return p;
}

SeedTable random_seeds_in_solid(const RandomSeeds& seeds, const Domain& domain) {
  Generator generator(seeds.seed);
  SeedTable table;
  table.dimension = 3;
  for (const RegionPoint& at : random_points(domain, seeds.count, seeds.seed)) {
    table.positions.insert(table.positions.end(), at.point.begin(), at.point.end());
    table.weights.push_back(seeds.low + generator.next() * (seeds.high - seeds.low));
  }
  return table;
}

[[noreturn]] void fail_spec(const std::string& spec, const std::string& what) {
  throw Error(ErrorCode::invalid_argument,
              fmt::format("seeds '{}': {}; write random:N[:LO:HI[:SEED]], e.g. random:1000:0:0.01:7",
                          readable(spec), what));
}

}  // namespace

RandomSeeds parse_random_spec(const std::string& spec) {
  std::vector<std::string_view> fields;
  std::string_view rest = spec;
  for (;;) {
    const std::size_t colon = rest.find(':');
    fields.push_back(rest.substr(0, colon));
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (fields.size() != 2 && fields.size() != 4 && fields.size() != 5)
    fail_spec(spec, "wrong number of fields");
  const auto whole = [&](std::string_view field, const char* what) {
    std::uint64_t value = 0;
    const auto [end, code] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (code != std::errc() || end != field.data() + field.size()) fail_spec(spec, what);
    return value;
  };
  RandomSeeds seeds;
  seeds.count = whole(fields[1], "N is not a whole number");
  if (seeds.count > most_seeds_of_diagram)
    fail_spec(spec, fmt::format("N is above {}", most_seeds_of_diagram));
  if (fields.size() >= 4) {
    if (parse_number(fields[2], seeds.low) != Parsed::ok) fail_spec(spec, "LO is not a number");
    if (parse_number(fields[3], seeds.high) != Parsed::ok) fail_spec(spec, "HI is not a number");
    if (seeds.low > seeds.high) fail_spec(spec, "LO is above HI");
  }
  if (fields.size() == 5) seeds.seed = whole(fields[4], "SEED is not a whole number");
  return seeds;
}

SeedTable random_seeds(const RandomSeeds& seeds, const Domain& domain) {
  if (domain.is_solid()) return random_seeds_in_solid(seeds, domain);
  const RegionsView mesh = domain.regions();
  const Pieces pieces = pieces_of(mesh);
  if (pieces.sum.empty())
    throw Error(ErrorCode::invalid_domain, "random seeds need a domain that is not empty");
  Generator generator(seeds.seed);
  SeedTable table;
  table.dimension = mesh.dimension;
  table.positions.reserve(seeds.count * static_cast<std::size_t>(mesh.dimension));
  table.weights.reserve(seeds.count);
  for (std::uint64_t k = 0; k < seeds.count; ++k) {
    const double target = generator.next() * pieces.sum.back();
    const auto found = std::upper_bound(pieces.sum.begin(), pieces.sum.end(), target);
    const auto piece = std::min<std::size_t>(static_cast<std::size_t>(found - pieces.sum.begin()),
                                             pieces.corners.size() - 1);
    const Vec p = point_in(mesh, pieces.corners[piece], generator);
    table.positions.insert(table.positions.end(), p.begin(), p.begin() + mesh.dimension);
    table.weights.push_back(seeds.low + generator.next() * (seeds.high - seeds.low));
  }
  return table;
}

}  // namespace powercell::io
