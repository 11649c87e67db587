// Any bits as seeds in device memory: each seed gets a status, the others are as without the bad ones, and
// after repair they are those of an exact diagram.
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <map>
#include <powercell/regions.hpp>
#include <span>

#include "tests/fuzz/device_density.hpp"
#include "tests/fuzz/laws.hpp"
#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

/// A wall of a row: the neighbour and, in a periodic domain, its image.
struct Wall {
  cl_uint neighbor;
  std::array<std::int32_t, 3> shift;
  auto operator<=>(const Wall&) const = default;
};

/// The rows of a diagram of n seeds, of which those with the status ok have walls. \throw Finding
template <class Real>
class Rows {
 public:
  static constexpr std::size_t room = 4096;  // more than 20 seeds can need
  Rows(std::size_t n, bool periodic)
      : n_(n),
        periodic_(periodic),
        offset_((n + 1) * sizeof(cl_uint)),
        neighbor_(room * sizeof(cl_uint)),
        wall_(room * sizeof(Real)),
        shift_(room * sizeof(Wall::shift)) {}
  DeviceAdjacency handles() const {
    return {offset_.handle, neighbor_.handle, wall_.handle, periodic_ ? shift_.handle : nullptr};
  }

  /// \return the walls of each seed
  std::vector<std::vector<Wall>> check(const std::vector<cl_uint>& status) const {
    const auto offset = read<cl_uint>(offset_, n_ + 1);
    require(offset[0] == 0 && std::is_sorted(offset.begin(), offset.end()) && offset[n_] <= room,
            "offsets of rows");
    const auto neighbor = read<cl_uint>(neighbor_, offset[n_]);
    const auto wall = read<Real>(wall_, offset[n_]);
    std::vector<std::array<std::int32_t, 3>> shift(offset[n_]);
    if (periodic_) shift = read<std::array<std::int32_t, 3>>(shift_, offset[n_]);
    std::vector<std::vector<Wall>> rows(n_);
    std::map<std::pair<cl_uint, Wall>, Real> found;
    for (cl_uint i = 0; i < n_; ++i)
      for (cl_uint k = offset[i]; k < offset[i + 1]; ++k) {
        const cl_uint j = neighbor[k];
        const Wall here{j, shift[k]};
        require(j < n_ && here != Wall{i, {}} && status[i] == 0 && status[j] == 0 && wall[k] > 0,
                "a wall that cannot be");
        require(rows[i].empty() || rows[i].back() < here, "a row that does not ascend");
        found[{i, here}] = wall[k];
        rows[i].push_back(here);
      }
    for (const auto& [side, measure] : found) {
      const auto& [i, there] = side;
      const auto back =
          found.find({there.neighbor, {i, {-there.shift[0], -there.shift[1], -there.shift[2]}}});
      require(back != found.end() && back->second == measure, "a wall with one side");
    }
    return rows;
  }

 private:
  std::size_t n_;
  bool periodic_;
  Memory offset_, neighbor_, wall_, shift_;
};

/// The parts of the boundary of the domain that cells have.
template <class Real>
class Boundary {
 public:
  Boundary(const Domain& domain, std::size_t n)
      : n_(n),
        facets_(domain.regions().boundary_count),
        offset_((n + 1) * sizeof(cl_uint)),
        facet_((n * facets_ + 1) * sizeof(cl_uint)),  // enough where each cell has each facet
        measure_((n * facets_ + 1) * sizeof(Real)) {}
  DeviceBoundaryWalls handles() const { return {offset_.handle, facet_.handle, measure_.handle}; }

  /// Rows ascend, and only cells that are there have any. \throw Finding
  void check(const std::vector<cl_uint>& status) const {
    const auto offset = read<cl_uint>(offset_, n_ + 1);
    require(offset[0] == 0 && std::is_sorted(offset.begin(), offset.end()) && offset[n_] <= n_ * facets_,
            "offsets of boundary walls");
    const auto facet = read<cl_uint>(facet_, offset[n_]);
    const auto measure = read<Real>(measure_, offset[n_]);
    for (cl_uint i = 0; i < n_; ++i)
      for (cl_uint k = offset[i]; k < offset[i + 1]; ++k)
        require(status[i] == 0 && facet[k] < facets_ && measure[k] >= 0 &&
                    (k == offset[i] || facet[k - 1] < facet[k]),
                "a boundary wall that cannot be");
  }

 private:
  std::size_t n_, facets_;
  Memory offset_, facet_, measure_;
};

/// Statuses and neighbours after repair are those of a Diagram without the invalid seeds. \throw Finding
void check_repaired(ExactTwin& twin, const std::vector<cl_uint>& status,
                    const std::vector<std::vector<Wall>>& walls) {
  const std::vector<cl_uint>& number = twin.number;
  const Adjacency& rows = twin.diagram.adjacency();
  for (std::size_t k = 0; k < number.size(); ++k) {
    const std::string seed = "repaired seed " + std::to_string(number[k]) + ": ";
    require(status[number[k]] == static_cast<cl_uint>(twin.diagram.measures().status[k]),
            seed + "another status");
    std::vector<Wall> row;
    for (std::uint64_t at = rows.offset[k]; at < rows.offset[k + 1]; ++at)
      row.push_back(
          {number[rows.neighbor[at]], rows.shift.empty() ? std::array<std::int32_t, 3>{} : rows.shift[at]});
    require(row == walls[number[k]], seed + "other neighbours");
  }
}

/// The masses that the device finds, of a status each, with those of valid seeds summing to the domain's.
/// \throw Finding
template <class Real>
void check_masses(const DeviceDiagram& diagram, const SeedInput& given, const std::vector<Real>& rows,
                  const std::vector<cl_uint>& status, const ExactTwin& twin) {
  const Domain& domain = diagram.domain();
  const std::size_t n = status.size(), d = static_cast<std::size_t>(domain.dimension());
  double total = 0;
  bool whole = !twin.number.empty();
  for (std::size_t i = 0; i < n; ++i) {
    const std::string seed = "seed " + std::to_string(i) + ": ";
    require(status[i] <= static_cast<cl_uint>(DeviceSeedStatus::unfinished), seed + "no status");
    const auto what = static_cast<DeviceSeedStatus>(status[i]);
    const double mass = rows[i * (2 + d)];
    bool finite = std::isfinite(given.weights[i]);
    for (std::size_t k = 0; k < d; ++k) finite = finite && std::isfinite(given.positions[i * d + k]);
    require(finite || what == DeviceSeedStatus::invalid, seed + "not finite, and not said so");
    if (what == DeviceSeedStatus::invalid || what == DeviceSeedStatus::unfinished) {
      require(std::isnan(mass), seed + "a measure of a cell that is not known");
      whole = whole && what == DeviceSeedStatus::invalid;
    } else {
      require(what == DeviceSeedStatus::ok ? mass > 0 : mass == 0, seed + "mass and status contradict");
      total += mass;
    }
  }
  const double allowed = twin.mass_doubt(diagram.precision());
  if (!whole || allowed >= 0.01 || std::fabs(total - domain.measure()) <= allowed * domain.measure()) return;
  std::string what = "the masses do not sum to the domain's; parts of it, with statuses:";
  for (std::size_t i = 0; i < n; ++i)
    what +=
        " " + std::to_string(rows[i * (2 + d)] / domain.measure()) + " (" + std::to_string(status[i]) + ")";
  throw Finding(what);
}

template <class Real>
void run(Input& input, const Domain& domain, Precision precision) {
  Options options;
  options.precision = precision;
  DeviceDiagram diagram(caller_device(), domain, options);
  const std::size_t n = input.below(20), d = static_cast<std::size_t>(domain.dimension());
  SeedInput given = any_seeds(input, domain, n);
  const std::vector<Real> positions(given.positions.begin(), given.positions.end());
  const std::vector<Real> weights(given.weights.begin(), given.weights.end());
  given = {{positions.begin(), positions.end()}, {weights.begin(), weights.end()}};
  const DeviceSeeds seeds{Memory(positions.size() * sizeof(Real), positions.data()),
                          Memory(n * sizeof(Real), weights.data()), static_cast<std::uint32_t>(n)};
  const Memory measure_memory(n * (2 + d) * sizeof(Real)), status_memory(n * sizeof(cl_uint));
  const Rows<Real> adjacency(n, domain.is_periodic());
  const Memory count(sizeof(cl_uint)), list(n * sizeof(cl_uint));
  const Boundary<Real> boundary(domain, n);
  const DeviceResults results{
      measure_memory.handle, status_memory.handle, adjacency.handles(), {count.handle, list.handle}, {},
      boundary.handles()};
  diagram.enqueue(seeds.positions.handle, seeds.weights.handle, seeds.count, results);
  const auto rows = read<Real>(measure_memory, n * (2 + d));
  const auto status = read<cl_uint>(status_memory, n);
  adjacency.check(status);
  boundary.check(status);
  ExactTwin twin(domain, options, given, status);
  check_masses(diagram, given, rows, status, twin);

  diagram.repair(seeds.positions.handle, seeds.weights.handle, seeds.count, results);
  const auto repaired = read<cl_uint>(status_memory, n);
  constexpr auto invalid = static_cast<cl_uint>(DeviceSeedStatus::invalid);
  for (std::size_t i = 0; i < n; ++i)
    require((status[i] == invalid) == (repaired[i] == invalid), "repair of an invalid seed");
  check_repaired(twin, repaired, adjacency.check(repaired));
  boundary.check(repaired);
  check_density<Real>(input, diagram, seeds, status, twin);
}

/// A box with some periodic axes, or a lattice, from any numbers.
Domain periodic_domain(Input& input, bool lattice) {
  const std::size_t d = input.flag() ? 3 : 2;
  if (lattice) return Domain::lattice(input.numbers(d * d), input.numbers(d));
  const std::size_t axes = input.byte();
  const bool periodic[] = {(axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0};
  const std::vector<double> low = input.numbers(d), size = input.numbers(d);
  std::vector<double> high;
  for (std::size_t k = 0; k < d; ++k) high.push_back(low[k] + std::fabs(size[k]));
  return Domain::periodic_box(low, high, std::span(periodic).first(d));
}

}  // namespace

void device_diagrams(Bytes bytes) {
  Input input(bytes);
  accepted({ErrorCode::invalid_domain, ErrorCode::unsupported}, [&] {
    const bool single = input.flag() || !shared_device().info().fp64;
    const std::size_t kind = input.below(6);
    const Domain domain = kind >= 4 ? periodic_domain(input, kind == 5)
                                    : make(kind == 3 ? any_domain(input) : good_domain(input));
    if (single)
      run<float>(input, domain, Precision::float32);
    else
      run<double>(input, domain, Precision::float64);
  });
}

}  // namespace powercell::fuzz
