// Prints a hash of the results of 161 runs: diagrams of every kind of domain, and the applications.
// A change that must not alter results prints the same lines before and after it:
//   diagram_bits examples/data >before; (change, build); diagram_bits examples/data | diff before -
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <powercell/powercell.hpp>
#include <string>
#include <vector>

#include "apps/io/read/domain.hpp"
#include "lib/base/random.hpp"

namespace {

using namespace powercell;

/// FNV-1a over the bytes of values. All NaN hash alike, since no operation specifies their bits.
class Hash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) state_ = (state_ ^ (word >> (8 * byte) & 0xff)) * 0x100000001b3u;
  }
  void add(double value) {
    add(std::bit_cast<std::uint64_t>(value == value ? value : std::numeric_limits<double>::quiet_NaN()));
  }
  void add(std::uint32_t value) { add(std::uint64_t{value}); }
  void add(int value) { add(static_cast<std::uint64_t>(value)); }
  void add(SeedStatus value) { add(static_cast<std::uint64_t>(value)); }
  void add(TreeNode value) { add(static_cast<std::uint64_t>(value)); }
  void add(const Border& border) {
    add(static_cast<std::uint64_t>(border.kind));
    add(border.index);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) add(value);
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

void add(Hash& hash, const Measures& m) {
  hash.add(m.mass);
  hash.add(m.centroid);
  hash.add(m.second_moment);
  hash.add(m.status);
}
void add(Hash& hash, const Adjacency& a) {
  hash.add(a.offset);
  hash.add(a.neighbor);
  hash.add(a.wall);
}
void add(Hash& hash, const Cells& c) {
  hash.add(c.cell_offset);
  hash.add(c.region);
  hash.add(c.vertex_offset);
  hash.add(c.vertices);
  hash.add(c.face_offset);
  hash.add(c.border);
  hash.add(c.loop_offset);
  hash.add(c.loop);
}
void add(Hash& hash, const JoinedCells& c) {
  hash.add(c.vertex_offset);
  hash.add(c.vertices);
  hash.add(c.face_offset);
  hash.add(c.face_border);
  hash.add(c.loop_offset);
  hash.add(c.loop);
  hash.add(c.edge_border);
}

void print_hash(const std::string& name, const Hash& hash) {
  std::printf("%-60s %016llx\n", name.c_str(), static_cast<unsigned long long>(hash.value()));
  std::fflush(stdout);
}
template <class... Results>
void print(const std::string& name, const Results&... results) {
  Hash hash;
  (add(hash, results), ...);
  print_hash(name, hash);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double uniform() {  // splitmix64
    const std::uint64_t bits = mixed_bits(state_);
    state_ += 0x9e3779b97f4a7c15u;
    return unit_from_bits(bits);
  }

 private:
  std::uint64_t state_;
};

struct Seeds {
  int dimension;
  std::vector<double> positions, weights;
  SeedsView view() const { return {dimension, positions, weights}; }
};

/// Uniform in the domain's bounding box enlarged by a twentieth on each side.
/// \param spread  range of the weights, in squares of the mean spacing
Seeds random_seeds(const Domain& domain, std::size_t n, double spread) {
  Random random(n + 17);
  const auto d = static_cast<std::size_t>(domain.dimension());
  Seeds seeds{domain.dimension(), {}, {}};
  double volume = 1;
  for (std::size_t k = 0; k < d; ++k) volume *= 1.1 * (domain.high()[k] - domain.low()[k]) + 1e-3;
  const double spacing = d == 2 ? std::sqrt(volume / double(n)) : std::cbrt(volume / double(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < d; ++k) {
      const double side = domain.high()[k] - domain.low()[k];
      seeds.positions.push_back(domain.low()[k] + side * (1.1 * random.uniform() - 0.05));
    }
    seeds.weights.push_back(spread * spacing * spacing * random.uniform());
  }
  return seeds;
}

/// A regular grid, where every decision is a tie, and three duplicates.
Seeds lattice(const Domain& domain, int across) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  Seeds seeds{domain.dimension(), {}, {}};
  const int layers = d == 3 ? across : 1;
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y < across; ++y)
      for (int x = 0; x < across; ++x) {
        const int at[3] = {x, y, z};
        for (std::size_t k = 0; k < d; ++k)
          seeds.positions.push_back(domain.low()[k] +
                                    (domain.high()[k] - domain.low()[k]) * (at[k] + 0.5) / across);
        seeds.weights.push_back(0);
      }
  const std::size_t one = d * 3;
  for (std::size_t k = 0; k < one; ++k) seeds.positions.push_back(seeds.positions[k]);
  seeds.weights.insert(seeds.weights.end(), 3, 0.0);
  return seeds;
}

void print_all(const std::string& name, const Device& device, const Domain& domain, const Seeds& seeds,
               const Options& options) {
  Diagram both(device, domain, options);
  both.set_seeds(seeds.view());
  both.compute(true, false);
  print(name + " measures, adjacency", both.measures(), both.adjacency());
  print(name + " cells, joined", both.cells(), join(domain, both.cells()));
  Hash hash;
  hash.add(both.dual().simplices);
  std::vector<double> weights = seeds.weights;
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 0.5 * weights[i] - (i % 7 == 0 ? 1e-3 : 0);
  both.set_weights(weights);
  add(hash, both.measures());
  add(hash, both.adjacency());
  both.set_weights(seeds.weights);
  add(hash, both.cells());
  print_hash(name + " dual, other weights", hash);
}

struct Shape {
  std::string name;
  Domain domain;
  std::size_t seeds;
  int across;
};

void print_diagrams(const Device& device, const std::vector<Shape>& shapes) {
  for (const Shape& shape : shapes) {
    for (const double spread : {0.0, 0.5, 4.0})
      print_all(shape.name + " spread " + std::to_string(spread).substr(0, 3), device, shape.domain,
                random_seeds(shape.domain, shape.seeds, spread), {});
    Options options;
    options.precision = Precision::float32;
    print_all(shape.name + " float", device, shape.domain, random_seeds(shape.domain, shape.seeds, 0.5),
              options);
    print_all(shape.name + " lattice", device, shape.domain, lattice(shape.domain, shape.across), {});
    options = {};
    options.decisions = Decisions::fast;
    options.chunk_pairs = 3000;
    print_all(shape.name + " fast, in chunks", device, shape.domain,
              random_seeds(shape.domain, shape.seeds, 4), options);
    options = {};
    options.neighbors = Neighbors::flann;
    print_all(shape.name + " flann", device, shape.domain, random_seeds(shape.domain, shape.seeds / 4, 0.5),
              options);
    options = {};
    options.certify = true;
    print_all(shape.name + " few, heavy", device, shape.domain, random_seeds(shape.domain, 12, 40), options);
  }
}

void print_transport(const std::string& name, const TransportResult& result) {
  Hash hash;
  hash.add(result.weights);
  hash.add(result.mass);
  hash.add(result.centroid);
  hash.add(static_cast<std::uint64_t>(result.diagrams));
  print_hash(name, hash);
}

void print_applications(const Device& device, const std::vector<Shape>& shapes,
                        const io::LoadedDomain& surface) {
  for (const Shape& shape : shapes) {
    const Seeds seeds = random_seeds(shape.domain, 300, 0);
    TransportOptions options;
    std::vector<double> masses;
    for (std::size_t i = 0; i < 300; ++i) masses.push_back(1.0 + static_cast<double>(i % 10));
    options.rescale = true;
    print_transport("transport " + shape.name,
                    transport(device, shape.domain, seeds.view(), masses, options));
    options.density = Density::formula("1 + x*x + abs(y)");
    print_transport("transport by a formula " + shape.name,
                    transport(device, shape.domain, {seeds.dimension, seeds.positions, {}}, {}, options));
    SamplingOptions sampling;
    sampling.iterations = 4;
    const SamplingResult points = sample(device, shape.domain, 200, sampling);
    Hash hash;
    hash.add(points.positions);
    hash.add(points.weights);
    print_hash("sample " + shape.name, hash);
  }
  for (const RemeshMethod method : {RemeshMethod::farthest_point, RemeshMethod::transport}) {
    RemeshOptions options;
    options.method = method;
    options.count = 1500;
    options.rounds = 5;
    options.device = device;
    const RemeshResult mesh = remesh(surface.vertices, surface.elements, options);
    Hash hash;
    hash.add(mesh.mesh.vertices);
    hash.add(mesh.mesh.triangles);
    print_hash(method == RemeshMethod::transport ? "remesh by transport" : "remesh", hash);
  }
}

void print_treemaps(const Device& device) {
  std::vector<std::int64_t> parent{TreeView::no_parent};
  std::vector<double> value{0};
  Random random(5);
  for (std::size_t i = 1; i < 800; ++i) {
    parent.push_back(static_cast<std::int64_t>(i < 12 ? 0 : 1 + i % 11));
    value.push_back(i < 12 ? 0 : 1 / (1e-3 + random.uniform()));
  }
  for (const std::size_t large : {std::size_t{4096}, std::size_t{64}}) {
    TreemapOptions options;
    options.device = device;
    options.large_group = large;
    const Treemap map = treemap({parent, value}, disk(64), options);
    Hash hash;
    hash.add(map.kind);
    hash.add(map.vertex_offset);
    hash.add(map.vertices);
    hash.add(map.seeds);
    print_hash("treemap, large groups from " + std::to_string(large), hash);
  }
}

void print_triangulations(const Device& device, const std::vector<Shape>& shapes) {
  for (const Shape& shape : shapes)
    for (const bool tied : {false, true}) {
      const Seeds seeds = tied ? lattice(shape.domain, shape.across) : random_seeds(shape.domain, 2000, 2);
      Hash hash;
      hash.add(regular_triangulation(device, seeds.view()).simplices);
      print_hash("triangulation " + shape.name + (tied ? " lattice" : ""), hash);
    }
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string data = argc > 1 ? argv[1] : "examples/data";
  const Device device = Device::choose();
  const io::LoadedDomain pretzel = io::read_domain(data + "/pretzel.off");
  const Shape square{"square", io::read_domain("square").domain, 20000, 40},
      cube{"cube", io::read_domain("cube").domain, 8000, 14};
  print_diagrams(device, {square,
                          cube,
                          {"italy", io::read_domain(data + "/italy.geojson").domain, 4000, 30},
                          {"pretzel", pretzel.domain, 4000, 12},
                          {"bracket", io::read_domain(data + "/bracket.mesh").domain, 3000, 8},
                          {"ball", io::read_domain("ball:6").domain, 3000, 8}});
  print_triangulations(device, {square, cube});
  print_applications(device,
                     {square,
                      {"sphere", io::read_domain("sphere:8").domain, 0, 0},
                      {"ball", io::read_domain("ball:4").domain, 0, 0}},
                     pretzel);
  print_treemaps(device);
  return 0;
} catch (const powercell::Error& error) {
  std::fprintf(stderr, "diagram_bits: %s\n", error.what());
  return 1;
}
