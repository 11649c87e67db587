#include "bench/contender.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <powercell/diagram.hpp>
#include <stdexcept>

#include "bench/peers.hpp"

namespace powercell::bench {

namespace {

template <class T>
std::size_t bytes_of(const std::vector<T>& v) {
  return v.size() * sizeof(T);
}

class Ours : public Contender {
 public:
  Ours(const Domain& domain, const SeedArray& seeds, const Options& options)
      : seeds_(seeds), diagram_(device(), domain, options) {}

  void prepare() override {
    // A few seeds build every kernel. Buffers grow in the first timed run, as those of the peers do.
    const std::size_t few = std::min<std::size_t>(seeds_.size(), 2000),
                      d = static_cast<std::size_t>(seeds_.dimension);
    diagram_.set_seeds(
        {seeds_.dimension, std::span(seeds_.positions).first(few * d), std::span(seeds_.weights).first(few)});
    compute();
    if (stage != "weights") return;
    // The same weights in reverse order: only what depends on positions alone can be kept.
    other_weights_.assign(seeds_.weights.rbegin(), seeds_.weights.rend());
    diagram_.set_seeds(seeds_.view());
    compute();
  }

  void forget() override {
    if (stage == "weights") {
      diagram_.set_weights(other_weights_);
      compute();
    } else {
      const std::vector<double> position(seeds_.positions.begin(),
                                         seeds_.positions.begin() + seeds_.dimension);
      diagram_.set_seeds({seeds_.dimension, position, {}});
      diagram_.measures();
    }
  }

  void run() override {
    if (stage == "weights")
      diagram_.set_weights(seeds_.weights);
    else
      diagram_.set_seeds(seeds_.view());
    compute();
  }

  double relative_error() override { return diagram_.measures().relative_error(); }
  double tolerance() const override { return diagram_.precision() == Precision::float32 ? 1e-4 : 1e-11; }

  std::size_t output_bytes() override {
    const Measures& m = diagram_.measures();
    std::size_t sum =
        bytes_of(m.mass) + bytes_of(m.centroid) + bytes_of(m.second_moment) + bytes_of(m.status);
    if (stage != "measures") {
      const Adjacency& a = diagram_.adjacency();
      sum += bytes_of(a.offset) + bytes_of(a.neighbor) + bytes_of(a.wall);
    }
    return sum;
  }

 private:
  void compute() { diagram_.compute(stage != "measures", false); }

  const SeedArray& seeds_;
  std::vector<double> other_weights_;
  Diagram diagram_;
};

class Peer : public Contender {
 public:
  using Function = std::function<std::vector<double>(const SeedsView&)>;
  Peer(Function function, double domain_measure, const SeedArray& seeds)
      : function_(std::move(function)), domain_measure_(domain_measure), seeds_(seeds) {
    peer = true;
  }

  void run() override {
    measures_.clear();
    measures_.shrink_to_fit();
    measures_ = function_(seeds_.view());
  }
  double relative_error() override {
    const double sum = std::accumulate(measures_.begin(), measures_.end(), 0.0);
    return std::abs(sum / domain_measure_ - 1);
  }
  double tolerance() const override { return 1e-7; }  // constructions and cuts of peers are not exact
  std::size_t output_bytes() override { return bytes_of(measures_); }

 private:
  Function function_;
  double domain_measure_;
  const SeedArray& seeds_;
  std::vector<double> measures_;
};

template <class Function>
Peer::Function in_box(Function function) {
  return [function](const SeedsView& seeds) { return function(seeds, Box{}); };
}

template <class Function>
Peer::Function on_mesh(const std::string& name, int corners, Function function) {
  return [=, mesh = mesh_of(name)](const SeedsView& seeds) { return function(seeds, mesh, corners); };
}

/// By domain and provider.
const std::map<std::string, std::map<std::string, Peer::Function>>& peer_functions() {
  const auto on_tetrahedra = [](const char* name) {
    return std::map<std::string, Peer::Function>{
        {"cgal-parallel", on_mesh(name, 4, cgal_parallel_measures_on)},
        {"cgal", on_mesh(name, 4, cgal_measures_on)}};
  };
  static const std::map<std::string, std::map<std::string, Peer::Function>> list = {
      {"box2", {{"cgal-parallel", in_box(cgal_parallel_measures_2d)}, {"cgal", in_box(cgal_measures_2d)}}},
      {"box3",
       {{"cgal-parallel", in_box(cgal_parallel_measures_3d)},
        {"voro++-parallel", in_box(voro_parallel_measures)},
        {"cgal", in_box(cgal_measures_3d)},
        {"voro++", in_box(voro_measures)}}},
      {"surface",
       {{"cgal-parallel", on_mesh("surface", 3, cgal_parallel_measures_on)},
        {"cgal", on_mesh("surface", 3, cgal_measures_on)}}},
      {"tets", on_tetrahedra("tets")},
      {"bracket", on_tetrahedra("bracket")},
      {"gyroid", on_tetrahedra("gyroid")},
  };
  return list;
}

bool is_parallel(const std::string& provider) {
  return provider.ends_with("-parallel");
}

}  // namespace

std::unique_ptr<Contender> our_contender(const std::string& stage, const std::string& provider,
                                         Precision precision, const Domain& domain, const SeedArray& seeds) {
  Options options;
  options.precision = precision;
  options.neighbors = provider == "flann" ? Neighbors::flann : Neighbors::tree;
  const auto d = static_cast<std::size_t>(domain.dimension());
  const std::array<double, 3> low = domain.low(), high = domain.high();
  auto made = std::make_unique<Ours>(
      stage == "periodic" ? Domain::periodic_box(std::span(low).first(d), std::span(high).first(d)) : domain,
      seeds, options);
  made->stage = stage;
  made->provider = provider;
  made->precision = precision == Precision::float32 ? "float" : "double";
  return made;
}

std::vector<std::string> peers_of(const std::string& domain) {
  std::vector<std::string> names;
  const auto found = peer_functions().find(domain);
  if (found == peer_functions().end()) return names;
  for (const bool parallel : {true, false})
    for (const auto& [name, function] : found->second)
      if (is_parallel(name) == parallel) names.push_back(name);
  return names;
}

std::unique_ptr<Contender> peer_contender(const std::string& provider, const Work& work,
                                          double domain_measure, const SeedArray& seeds) {
  const auto domain = peer_functions().find(work.domain);
  if (domain == peer_functions().end() || !domain->second.contains(provider))
    throw std::invalid_argument("no peer '" + provider + "' for the domain '" + work.domain + "'");
  auto made = std::make_unique<Peer>(domain->second.at(provider), domain_measure, seeds);
  made->stage = "measures";
  made->precision = "double";
  made->provider = provider;
  return made;
}

bool has_flann() {
#ifdef POWERCELL_TEST_FLANN
  return true;
#else
  return false;
#endif
}

const Device& device() {
  static const Device chosen = Device::choose();
  return chosen;
}

}  // namespace powercell::bench
