// A diagram used in any order of calls, with any numbers; where the library accepts them, the laws hold.
#include <powercell/diagram.hpp>
#include <powercell/verify.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "tests/fuzz/laws.hpp"
#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

/// One diagram and the seeds it should have by now.
class Session {
 public:
  Session(Input& input, const Domain& domain, const Options& options)
      : input_(input), diagram_(shared_device(), domain, options), decisions_(options.decisions) {}

  /// Calls something, and tells of the input when that finds something.
  void step() {
    try {
      any_step();
    } catch (const Finding& finding) {
      if (decisions_ == Decisions::fast) return;  // rounding may have decided anything
      throw Finding(finding.what() + description());
    } catch (const Error& error) {
      const bool refused = std::string_view(error.what()).starts_with("the certificate of the diagram");
      if (!refused) throw;
      if (!beyond_rounding()) throw Finding(error.what() + description());
    }
  }

  void set_seeds() {
    SeedInput next = any_seeds(input_, diagram_.domain(), input_.below(20));
    diagram_.set_seeds({diagram_.domain().dimension(), next.positions, next.weights});
    seeds_ = std::move(next);  // only if accepted: a diagram that refuses keeps what it has
  }

 private:
  void any_step() {
    switch (input_.below(8)) {
      case 0:
        set_seeds();
        break;
      case 1:
        set_weights();
        break;
      case 2:
        check_adjacency(diagram_.adjacency(), diagram_.measures());
        break;
      case 3:
        check_cells(diagram_.cells(), diagram_.domain(), view(), error());
        break;
      case 4:
        check_dual(diagram_.dual(), diagram_.measures());
        break;
      case 5:
        check_joined(join(diagram_.domain(), diagram_.cells()), view().size());
        break;
      case 6:
        check_verify();
        break;
      default:
        check_measures(diagram_.measures(), diagram_.domain(), view(), error());
    }
  }

  SeedsView view() const { return {diagram_.domain().dimension(), seeds_.positions, seeds_.weights}; }
  /// Domain and seeds, with digits that give them back.
  std::string description() const {
    std::ostringstream text;
    text.precision(17);
    const Domain& domain = diagram_.domain();
    text << "\n  " << domain.region_count() << " regions in the box";
    for (const double x : domain.low()) text << ' ' << x;
    text << " to";
    for (const double x : domain.high()) text << ' ' << x;
    text << (diagram_.precision() == Precision::float32 ? ", single precision" : ", double precision");
    const auto d = static_cast<std::size_t>(view().dimension);
    for (std::size_t i = 0; i < view().size(); ++i) {
      text << "\n  seed " << i << ':';
      for (std::size_t k = 0; k < d; ++k) text << ' ' << seeds_.positions[i * d + k];
      text << " weight " << (seeds_.weights.empty() ? 0 : seeds_.weights[i]);
    }
    return text.str();
  }
  double error() const { return plane_error(diagram_.domain(), view(), diagram_.precision()); }

  void set_weights() {
    std::vector<double> next = input_.numbers(input_.below(8) == 7 ? input_.below(20) : diagram_.size());
    diagram_.set_weights(next);
    require(next.size() == view().size(), "weights of another number than the seeds were accepted");
    seeds_.weights = std::move(next);
  }

  /// Seeds so far away, or a domain so long beside its width, that rounding leaves nothing of them: verify
  /// and certificate may say so.
  bool beyond_rounding() const {
    const auto low = diagram_.domain().low(), high = diagram_.domain().high();
    const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    return error() > 1e-9 * size || sum_doubt(diagram_.domain(), view().size(), error()) >= 0.01;
  }

  void check_verify() {
    const auto checks = verify(diagram_, view(), {20, input_.byte()});
    if (beyond_rounding()) return;
    for (const LawCheck& check : checks) require(check.passed, check.law + ": " + check.detail);
  }

  Input& input_;
  Diagram diagram_;
  Decisions decisions_;
  SeedInput seeds_;
};

Options any_options(Input& input) {
  Options options;
  const std::size_t choice = input.below(32);
  if (choice & 1) options.precision = Precision::float32;
  if (choice & 2) options.neighbors = Neighbors::flann;
  if (choice & 4) options.chunk_pairs = 1 + input.below(40);
  options.certify = (choice & 8) != 0;
  if ((choice & 24) == 16) options.decisions = Decisions::fast;
  options.threads = 1;
  if (input.below(32) == 31) {
    options.initial_neighbors = static_cast<int>(input.byte()) - 100;
    options.lift_eta = input.number();
    options.threads = static_cast<int>(input.byte()) - 100;
    options.twin_queries = input.flag();
  }
  return options;
}

}  // namespace

void diagrams(Bytes bytes) {
  Input input(bytes);
  const Options options = any_options(input);
  accepted(kCallersFaults, [&] {
    const Domain domain = make(input.below(4) == 3 ? any_domain(input) : good_domain(input));
    Session session(input, domain, options);
    accepted(kCallersFaults, [&] { session.set_seeds(); });
    for (int steps = 0; steps < 8 && !input.at_end(); ++steps)
      accepted(kCallersFaults, [&] { session.step(); });
  });
}

}  // namespace powercell::fuzz
