#include "lib/applications/transport/ranks/rank_evaluator.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "lib/applications/transport/diagram_evaluator.hpp"
#include "lib/base/disjoint_sets.hpp"

namespace powercell {
namespace {

/// Walls with indices in place of numbers, sorted again within each row.
Adjacency walls_by_index(const DistributedCells& cells, const Beyond& beyond) {
  Adjacency walls;
  walls.offset = cells.offset;
  std::vector<std::pair<std::uint32_t, double>> row;
  for (std::size_t i = 0; i + 1 < cells.offset.size(); ++i) {
    row.clear();
    for (std::uint64_t k = cells.offset[i]; k < cells.offset[i + 1]; ++k)
      row.emplace_back(beyond.index(cells.neighbor[k]), cells.wall[k]);
    std::sort(row.begin(), row.end());
    for (const auto& [index, wall] : row) {
      walls.neighbor.push_back(index);
      walls.wall.push_back(wall);
    }
  }
  return walls;
}

/// Groups of rows here that entries connect, by their least row, and entries between them and groups
/// elsewhere.
struct Groups {
  std::vector<std::uint64_t> group;
  std::vector<std::uint64_t> link;  ///< pairs
};

/// The number of sets into which links join the groups of all ranks.
std::size_t joined(const std::vector<Bytes>& of_ranks) {
  std::map<std::uint64_t, std::uint32_t> index;
  std::vector<std::uint64_t> links;
  for (const Bytes& bytes : of_ranks) {
    Groups groups;
    unpack(bytes, groups.group, groups.link);
    for (const std::uint64_t group : groups.group)
      index.emplace(group, static_cast<std::uint32_t>(index.size()));
    links.insert(links.end(), groups.link.begin(), groups.link.end());
  }
  DisjointSets sets(index.size());
  for (std::size_t k = 0; k < links.size(); k += 2) sets.unite(index.at(links[k]), index.at(links[k + 1]));
  std::size_t count = 0;
  for (std::uint32_t k = 0; k < sets.size(); ++k) count += sets.root(k) == k ? 1 : 0;
  return count;
}

}  // namespace

RankEvaluator::RankEvaluator(const OnRanks& ranks, const Device& device, const Domain& domain, double density,
                             const std::vector<std::uint32_t>& kept, std::span<const double> positions,
                             const DistributedTransportOptions& options)
    : Evaluator(domain, positions, ranks.all),
      ranks_(ranks),
      device_(device),
      density_(density),
      options_(options),
      beyond_(kept, positions, dimension(), ranks.numbers, ranks.mailbox) {
  for (const std::uint32_t i : kept) ids_.push_back(ranks.numbers.first() + i);
}

DistributedCells RankEvaluator::cells_of(const Vector& weights) const {
  DistributedOptions options;
  options.diagram = options_.transport.diagram;
  options.redistribute = options_.redistribute;
  const SeedsView seeds{
      domain().dimension(), positions(), {weights.data(), static_cast<std::size_t>(weights.size())}};
  return ranks_.mailbox.nested(
      [&] { return compute_distributed(ranks_.communicator, device_, domain(), ids_, seeds, options); });
}

void RankEvaluator::measure(Iterate& at) {
  DistributedCells cells = cells_of(at.weights);
  at.cells.dimension = cells.measures.dimension;
  at.cells.mass = std::move(cells.measures.mass);
  at.cells.centroid = std::move(cells.measures.centroid);
  at.cells.second_moment = std::move(cells.measures.second_moment);
  at.cells.status = std::move(cells.measures.status);
  beyond_.meet(cells.neighbor);
  at.cells.walls = walls_by_index(cells, beyond_);
  for (std::vector<double>* values : {&at.cells.mass, &at.cells.second_moment, &at.cells.walls.wall})
    for (double& value : *values) value *= density_;
  at.beyond = beyond_.values(at.weights);
  at.conductance = plane_conductances(at.cells.walls, beyond_.positions(), dimension());
}

bool RankEvaluator::connects_all(const Laplacian& system) {
  const SparseRows& matrix = system.matrix;
  const auto n = static_cast<std::uint32_t>(matrix.rows());
  DisjointSets sets(static_cast<std::size_t>(matrix.cols()));
  const auto for_each = [&](const auto& body) {
    for (std::uint32_t i = 0; i < n; ++i)
      for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry)
        if (entry.value() != 0) body(i, static_cast<std::uint32_t>(entry.col()));
  };
  for_each([&](std::uint32_t i, std::uint32_t j) {
    if (j < n) sets.unite(i, j);
  });
  Groups groups;
  Vector label(n);  // rows are fewer than 2^53
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t root = sets.root(i);
    if (root == i) groups.group.push_back(beyond_.row(i));
    label[i] = static_cast<double>(beyond_.row(root));
  }
  const Vector elsewhere = beyond_.values(label);
  std::set<std::pair<std::uint64_t, std::uint64_t>> links;
  for_each([&](std::uint32_t i, std::uint32_t j) {
    if (j >= n)
      links.emplace(static_cast<std::uint64_t>(label[i]), static_cast<std::uint64_t>(elsewhere[j - n]));
  });
  for (const auto& [a, b] : links) {
    groups.link.push_back(a);
    groups.link.push_back(b);
  }
  return joined(ranks_.mailbox.share({packed(groups.group, groups.link)})) == 1;
}

DistributedSolution RankEvaluator::solution(const Laplacian& system, const Vector& right) {
  const SparseRows& matrix = system.matrix;
  std::vector<std::uint64_t> offset{0}, column;
  std::vector<double> value;
  std::vector<std::pair<std::uint64_t, double>> row;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    row.clear();
    for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry)
      row.emplace_back(beyond_.row(static_cast<std::size_t>(entry.col())), entry.value());
    std::sort(row.begin(), row.end());
    for (const auto& [to, coefficient] : row) {
      column.push_back(to);
      value.push_back(coefficient);
    }
    offset.push_back(column.size());
  }
  const DistributedRows rows{beyond_.rows().first(), count(), offset, column, value, system.singular};
  ranks_.mailbox.meet();  // nobody enters the solver alone
  return ranks_.mailbox.nested([&] {
    return ranks_.solver.solve(rows, {right.data(), static_cast<std::size_t>(right.size())},
                               options_.transport.linear_residual);
  });
}

LinearResult RankEvaluator::solve(const Laplacian& system, const Vector& right) {
  const AllSeeds& sums = all();
  const auto subtract_mean = [&](Vector& of) {
    if (system.singular) of.array() -= sums.sum_of(of) / static_cast<double>(count());
  };
  LinearResult result;
  Vector b = right;
  subtract_mean(b);
  const double size = sums.norm(b);
  result.solution = Vector::Zero(b.size());
  if (size == 0) return result;
  const DistributedSolution found = solution(system, b);
  if (found.values.size() != static_cast<std::size_t>(b.size()))
    throw Error(ErrorCode::invalid_argument, "a linear solver gave " + std::to_string(found.values.size()) +
                                                 " values for " + std::to_string(b.size()) + " rows");
  result.iterations = found.iterations;
  result.solution = Eigen::Map<const Vector>(found.values.data(), b.size());
  result.broke_down = sums.any(!result.solution.allFinite());
  if (result.broke_down) return result;
  subtract_mean(result.solution);
  const Vector elsewhere = beyond_.values(result.solution);
  Vector x(system.matrix.cols());
  x.head(b.size()) = result.solution;
  x.tail(x.size() - b.size()) = elsewhere.head(x.size() - b.size());
  result.residual = sums.norm(b - system.matrix * x) / size;
  return result;
}

}  // namespace powercell
