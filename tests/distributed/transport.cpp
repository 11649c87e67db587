// Transport on ranks that are threads, with the transport of all seeds in one process as the oracle. The
// linear systems are gathered on each rank and solved there, so that only the rest is tested.
#include "tests/distributed/transport.hpp"

#include <stdexcept>

#include "lib/applications/linear/laplacian.hpp"
#include "lib/base/bytes.hpp"
#include "tests/support/loopback.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Solves systems of all rows on each rank.
class GatheringSolver : public DistributedLinearSolver {
 public:
  explicit GatheringSolver(Communicator& communicator) : communicator_(communicator) {}

  DistributedSolution solve(const DistributedRows& rows, std::span<const double> right, double) override {
    const std::vector<std::uint64_t> own_offset(rows.offset.begin(), rows.offset.end()),
        own_column(rows.column.begin(), rows.column.end());
    const std::vector<double> own_value(rows.value.begin(), rows.value.end()),
        own_right(right.begin(), right.end());
    std::vector<Eigen::Triplet<double>> entries;
    Vector b(static_cast<Eigen::Index>(rows.total));
    Eigen::Index i = 0;
    for (const Bytes& bytes :
         communicator_.exchange(std::vector<Bytes>(static_cast<std::size_t>(communicator_.size()),
                                                   packed(own_offset, own_column, own_value, own_right)))) {
      std::vector<std::uint64_t> offset, column;
      std::vector<double> value, of_rank;
      unpack(bytes, offset, column, value, of_rank);
      for (std::size_t row = 0; row < of_rank.size(); ++row, ++i) {
        b[i] = of_rank[row];
        for (std::uint64_t k = offset[row]; k < offset[row + 1]; ++k) {
          ascending_ = ascending_ && (k == offset[row] || column[k - 1] < column[k]);
          entries.emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(column[k]), value[k]);
        }
      }
    }
    Laplacian system;
    system.matrix.resize(b.size(), b.size());
    system.matrix.setFromTriplets(entries.begin(), entries.end());
    system.singular = rows.singular;
    const SparseRows transposed = system.matrix.transpose();
    asymmetry_ = std::max(asymmetry_, (transposed - system.matrix).norm() / system.matrix.norm());
    if (rows.singular)
      row_sum_ = std::max(row_sum_, (system.matrix * Vector::Ones(b.size())).norm() / system.matrix.norm());
    const LinearResult all = solve_laplacian(system, b, LinearSolver::direct, 1e-4, 2);
    const double* const own = all.solution.data() + rows.first;
    return {std::vector<double>(own, own + right.size()), 0};
  }

  /// All systems so far were Laplacians as DistributedRows promises.
  bool were_laplacians() const { return ascending_ && asymmetry_ < 1e-13 && row_sum_ < 1e-13; }

 private:
  Communicator& communicator_;
  bool ascending_ = true;
  double asymmetry_ = 0, row_sum_ = 0;
};

/// The results of each rank. \throw what the first rank threw that did
std::vector<TransportResult> solve_on_ranks(const TransportProblem& problem, const Shares& shares,
                                            const DistributedTransportOptions& options = {}) {
  std::vector<TransportResult> results(shares.ids.size());
  std::vector<char> good(shares.ids.size());
  for (const std::exception_ptr& thrown : on_ranks(shares.ids.size(), [&](Communicator& communicator) {
         GatheringSolver solver(communicator);
         const auto rank = static_cast<std::size_t>(communicator.rank());
         results[rank] = solve_rank(communicator, solver, problem, shares, options);
         good[rank] = solver.were_laplacians();
       }))
    if (thrown) std::rethrow_exception(thrown);
  for (const char is_good : good) CHECK(is_good);
  return results;
}

void check_on_ranks(const TransportProblem& problem, const Shares& shares, const TransportResult& expected,
                    const DistributedTransportOptions& options = {}, int more = 1) {
  const std::vector<TransportResult> found = solve_on_ranks(problem, shares, options);
  for (std::size_t rank = 0; rank < found.size(); ++rank) {
    CAPTURE(rank);
    check_rank_solution(problem, shares.ids[rank], found[rank], expected, more);
    CHECK(found[rank].error == found[0].error);
    CHECK(found[rank].dual == found[0].dual);
    REQUIRE(found[rank].steps.size() == found[0].steps.size());
    for (std::size_t k = 0; k < found[0].steps.size(); ++k)
      CHECK(found[rank].steps[k].gradient == found[0].steps[k].gradient);
  }
}

TransportProblem problem_of(const Domain& domain, Distribution distribution, std::size_t n, double range,
                            Random& random) {
  SeedArray seeds = random_seeds(distribution, WeightRange::W0, n, domain.dimension(), random);
  return {domain, std::move(seeds), range > 1 ? masses_for(domain, n, range, random) : std::vector<double>()};
}

/// What each rank throws: the text, or nothing.
std::vector<std::string> refusals(
    std::size_t ranks,
    const std::function<void(Communicator&, DistributedLinearSolver&, std::size_t)>& work) {
  std::vector<std::string> texts(ranks);
  on_ranks(ranks, [&](Communicator& communicator) {
    GatheringSolver solver(communicator);
    const auto rank = static_cast<std::size_t>(communicator.rank());
    try {
      work(communicator, solver, rank);
    } catch (const std::exception& error) {
      texts[rank] = error.what();
    }
  });
  return texts;
}

void check_refused(const std::vector<std::string>& texts, const std::string& begin) {
  for (const std::string& text : texts) {
    CAPTURE(text);
    CHECK(text.starts_with(begin));
  }
}

}  // namespace

TEST_CASE("transport on ranks: the steps and weights of one process") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const Distribution distribution : {Distribution::white, Distribution::cluster})
      for (const double range : {1.0, 5.0}) {
        INFO(dimension << "D " << name(distribution) << ", masses over " << range);
        const TransportProblem problem = problem_of(unit_box(dimension), distribution, 150, range, random);
        const TransportResult expected = in_one_process(problem);
        const int more = distribution == Distribution::cluster ? from_afar : 1;
        for (const std::size_t ranks : {1U, 2U, 3U})
          check_on_ranks(problem, along_curve(problem.seeds, ranks), expected, {}, more);
        check_on_ranks(problem, at_random(problem.seeds, 3, random), expected, {{}, true}, more);
      }
}

TEST_CASE("transport on ranks: a polygon with a hole, a density, and seeds outside") {
  INFO(replay_hint());
  Random random(test_seed());
  TransportProblem problem{
      Domain::polygon(letter_u()), random_seeds(Distribution::white, WeightRange::W0, 60, 2, random), {}};
  for (double& x : problem.seeds.positions) x = 5 + 0.1 * x;
  DistributedTransportOptions options;
  options.transport.density = Density::constant(0.3);
  const TransportResult expected =
      transport(test_device(), problem.domain, problem.seeds.view(), {}, options.transport);
  CHECK(expected.total_mass < 0.9 * problem.domain.measure());
  check_on_ranks(problem, at_random(problem.seeds, 3, random), expected, options, from_afar);
}

TEST_CASE("transport on ranks: empty ranks, more ranks than seeds, one seed") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const std::size_t n : {1U, 2U, 40U}) {
    const TransportProblem problem = problem_of(unit_box(3), Distribution::white, n, 3, random);
    std::vector<std::size_t> rank(n, 3);
    rank[0] = 1;
    check_on_ranks(problem, {problem.seeds, rank, 5}, in_one_process(problem));
  }
}

TEST_CASE("transport on ranks: seeds at one position on several ranks, and weights that hide seeds") {
  INFO(replay_hint());
  Random random(test_seed());
  TransportProblem problem = problem_of(unit_box(2), Distribution::white, 90, 4, random);
  for (std::size_t i = 60; i < 90; ++i)
    for (std::size_t c = 0; c < 2; ++c)
      problem.seeds.positions[2 * i + c] = problem.seeds.positions[2 * (i % 15) + c];
  const Shares shares = along_curve(problem.seeds, 1), spread = at_random(problem.seeds, 4, random);
  check_on_ranks(problem, shares, in_one_process(problem));
  // On other ranks another of the seeds at a position is the first.
  const std::vector<TransportResult> found = solve_on_ranks(problem, spread);
  const TransportResult expected = in_one_process(problem);
  double sum = 0;
  for (std::size_t rank = 0; rank < 4; ++rank) {
    CHECK(found[rank].converged);
    CHECK(found[rank].merged == 30);
    for (std::size_t k = 0; k < spread.ids[rank].size(); ++k) {
      CHECK(std::abs(found[rank].weights[k] - expected.weights[spread.ids[rank][k]]) < 1e-6);
      sum += found[rank].mass[k];
    }
  }
  CHECK(sum == doctest::Approx(1).epsilon(1e-12));

  TransportProblem hidden = problem_of(unit_box(2), Distribution::white, 90, 1, random);
  for (std::size_t i = 0; i < 90; i += 7) hidden.seeds.weights[i] = -0.3;
  const TransportResult from_hidden = in_one_process(hidden);
  CHECK(from_hidden.steps.front().diagrams > 1);
  check_on_ranks(hidden, along_curve(hidden.seeds, 3), from_hidden);
}

TEST_CASE(
    "transport on ranks: a solve that starts from a solution takes no step, and few after seeds moved") {
  INFO(replay_hint());
  Random random(test_seed());
  TransportProblem problem = problem_of(unit_box(2), Distribution::white, 120, 3, random);
  const TransportResult first = in_one_process(problem);
  problem.seeds.weights = first.weights;
  for (const TransportResult& again : solve_on_ranks(problem, along_curve(problem.seeds, 3)))
    CHECK(again.newton_steps() == 0);
  for (std::size_t i = 0; i < 120; ++i)
    for (std::size_t c = 0; c < 2; ++c) {
      const double by = (first.centroid[2 * i + c] - problem.seeds.positions[2 * i + c]) / 4;
      problem.seeds.positions[2 * i + c] += by;
      problem.seeds.weights[i] -= by * by;
    }
  check_on_ranks(problem, along_curve(problem.seeds, 3), in_one_process(problem));
}

TEST_CASE("transport on ranks: islands, whose cells share no wall, are solved or reported as not converged") {
  INFO(replay_hint());
  Random random(test_seed());
  const Domain domain = Domain::polygon(islands());
  const TransportProblem problem{
      domain, seeds_for(domain, Distribution::white, WeightRange::W0, 40, random), {}};
  DistributedTransportOptions options;
  options.transport.max_steps = 40;
  const Shares shares = along_curve(problem.seeds, 2);
  const std::vector<TransportResult> found = solve_on_ranks(problem, shares, options);
  // Whether the steps reach it is left open; what is reported must be what another diagram has.
  SeedArray solved = problem.seeds;
  double error = 0;
  for (std::size_t rank = 0; rank < 2; ++rank)
    for (std::size_t k = 0; k < shares.ids[rank].size(); ++k)
      solved.weights[shares.ids[rank][k]] = found[rank].weights[k];
  Diagram diagram = diagram_of(domain, solved);
  for (const double mass : diagram.measures().mass)
    error = std::max(error, std::abs(mass * 40 / domain.measure() - 1));
  CHECK(std::abs(found[0].error - error) < 1e-9 * std::max(1.0, error));
  CHECK(found[0].converged == (found[0].error < 1e-6));
  CHECK(found[1].converged == found[0].converged);
}

TEST_CASE("transport on ranks: the limit on steps, and a solver without a solution") {
  INFO(replay_hint());
  Random random(test_seed());
  const TransportProblem problem = problem_of(unit_box(2), Distribution::white, 80, 3, random);
  DistributedTransportOptions options;
  options.transport.max_steps = 1;
  for (const TransportResult& found : solve_on_ranks(problem, along_curve(problem.seeds, 2), options)) {
    CHECK(!found.converged);
    CHECK(found.newton_steps() == 1);
  }
  struct Failing : DistributedLinearSolver {
    DistributedSolution solve(const DistributedRows&, std::span<const double> right, double) override {
      return {std::vector<double>(right.size(), std::numeric_limits<double>::quiet_NaN()), 7};
    }
  } failing;
  options.transport.max_steps = 20;
  for (const std::exception_ptr& thrown : on_ranks(2, [&](Communicator& communicator) {
         const TransportResult found =
             solve_rank(communicator, failing, problem, along_curve(problem.seeds, 2), options);
         if (found.converged || found.newton_steps() != 0) throw std::logic_error("it converged");
       }))
    CHECK(!thrown);
}

TEST_CASE("transport on ranks: what is wrong on one rank is refused on all, who then solve") {
  INFO(replay_hint());
  Random random(test_seed());
  const TransportProblem problem = problem_of(unit_box(2), Distribution::white, 60, 3, random);
  const Shares shares = along_curve(problem.seeds, 3);
  using Work = std::function<void(SeedsView&, std::vector<double>&, DistributedTransportOptions&)>;
  const auto refused_on_rank_1 = [&](const std::string& begin, const Work& spoil) {
    CAPTURE(begin);
    std::vector<char> went_on(3);
    const auto texts = refusals(3, [&](Communicator& communicator, DistributedLinearSolver& solver,
                                       std::size_t rank) {
      SeedsView seeds{2, shares.positions[rank], shares.weights[rank]};
      std::vector<double> masses = masses_of(problem, shares.ids[rank]);
      DistributedTransportOptions options;
      if (rank == 1) spoil(seeds, masses, options);
      try {
        transport_distributed(communicator, solver, test_device(), problem.domain, seeds, masses, options);
      } catch (...) {
        went_on[rank] = solve_rank(communicator, solver, problem, shares).converged;
        throw;
      }
    });
    check_refused(texts, begin);
    for (const char on : went_on) CHECK(on);
  };
  std::vector<double> bad = shares.positions[1];
  bad[7] = std::numeric_limits<double>::quiet_NaN();
  refused_on_rank_1("rank 1: seed 23: a coordinate is not finite",
                    [&](auto& seeds, auto&, auto&) { seeds.positions = bad; });
  std::vector<double> infinite(20, 0.0);
  infinite[2] = std::numeric_limits<double>::infinity();
  refused_on_rank_1("rank 1: seed 22: the weight is not finite",
                    [&](auto& seeds, auto&, auto&) { seeds.weights = infinite; });
  refused_on_rank_1("rank 1: 19 masses for 20 seeds", [](auto&, auto& masses, auto&) { masses.pop_back(); });
  refused_on_rank_1("rank 1: 0 masses for 20 seeds", [](auto&, auto& masses, auto&) { masses.clear(); });
  refused_on_rank_1("rank 1: seed 20: the mass is 0", [](auto&, auto& masses, auto&) { masses[0] = 0; });
  refused_on_rank_1("the masses sum to ", [](auto&, auto& masses, auto&) { masses[0] *= 2; });
  refused_on_rank_1("rank 1: seeds of dimension 3", [](auto& seeds, auto&, auto&) { seeds.dimension = 3; });
  refused_on_rank_1("ranks 0 and 1 differ in TransportOptions::tolerance",
                    [](auto&, auto&, auto& options) { options.transport.tolerance = 1e-3; });
  refused_on_rank_1("ranks 0 and 1 differ in the mass of the domain, TransportOptions::max_steps",
                    [](auto&, auto&, auto& options) {
                      options.transport.max_steps = 7;
                      options.transport.density = Density::constant(2);
                    });
  refused_on_rank_1("rank 1: the tolerance must be",
                    [](auto&, auto&, auto& options) { options.transport.tolerance = 2; });
  refused_on_rank_1("rank 1: a transport over ranks needs a constant density",
                    [](auto&, auto&, auto& options) { options.transport.density = Density::formula("1+x"); });
  refused_on_rank_1("rank 1: a transport over ranks needs a domain that is not periodic",
                    [](auto&, auto&, auto& options) { options.transport.periodic = true; });
  refused_on_rank_1("rank 1: a transport over ranks has its linear solver",
                    [](auto&, auto&, auto& options) { options.transport.linear = LinearSolver::direct; });
  refused_on_rank_1("ranks 0 and 1 differ in DistributedOptions::redistribute",
                    [](auto&, auto&, auto& options) { options.redistribute = true; });
  refused_on_rank_1("rank 1: interrupted", [](auto&, auto&, auto& options) {
    options.transport.progress = [](const TransportStep& step) { return step.step < 2; };
  });
  refused_on_rank_1("rank 1: ", [](auto&, auto&, auto& options) {
    options.transport.diagram.progress = [](double) { return false; };
  });
}

TEST_CASE("transport on ranks: no seeds, surfaces, and solvers that throw or give too little") {
  INFO(replay_hint());
  Random random(test_seed());
  const TransportProblem problem = problem_of(unit_box(2), Distribution::white, 60, 3, random);
  const Shares shares = along_curve(problem.seeds, 2);
  check_refused(
      refusals(2,
               [&](Communicator& communicator, DistributedLinearSolver& solver, std::size_t) {
                 transport_distributed(communicator, solver, test_device(), problem.domain, {2, {}, {}});
               }),
      "no seeds: ");
  struct Throwing : DistributedLinearSolver {
    DistributedSolution solve(const DistributedRows&, std::span<const double>, double) override {
      throw std::runtime_error("singular");
    }
  } throwing;
  struct Short : DistributedLinearSolver {
    DistributedSolution solve(const DistributedRows&, std::span<const double>, double) override {
      return {{1}, 1};
    }
  } too_short;
  const auto with = [&](DistributedLinearSolver& other) {
    return refusals(2, [&](Communicator& communicator, DistributedLinearSolver&, std::size_t) {
      solve_rank(communicator, other, problem, shares);
    });
  };
  check_refused(with(throwing), "singular");
  check_refused(with(too_short), "a linear solver gave 1 values for 30 rows");
}
