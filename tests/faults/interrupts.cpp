// A progress callback that stops the computation, or throws, at each of its calls.
#include <doctest/doctest.h>

#include <stdexcept>

#include "tests/faults/jobs.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("the caller's own") {}
};

/// Counts calls; the nth stops the computation.
struct Progress {
  int calls = 0, stop_at = 0;
  bool by_exception = false;
  bool operator()() {
    if (++calls != stop_at) return true;
    if (by_exception) throw Stopped();
    return false;
  }
};

}  // namespace

TEST_CASE("a diagram stopped at any call of the callback continues to the same bits") {
  for (const Setup& setup : main_setups())
    for (const SeededDomain& small : small_cases()) {
      INFO(small.domain.name << ", " << setup.name);
      Progress progress;
      Options options = setup.options;
      options.chunk_pairs = 24;
      options.progress = [&](double) { return progress(); };
      const auto results = [&](Diagram& diagram) {
        diagram.set_seeds(small.seeds.view());
        return results_of(diagram);
      };
      Diagram diagram(setup.device, small.domain.domain, options);
      const Results expected = results(diagram);
      const int calls = progress.calls;
      REQUIRE(calls > 0);
      for (int n = 1; n <= calls; n += std::max(1, calls / 6))
        for (const bool by_exception : {false, true}) {
          CAPTURE(n);
          progress = {0, n, by_exception};
          const shim::Alive before = shim::alive();
          bool stopped = false;
          try {
            results(diagram);
          } catch (const Error& error) {
            stopped = true;
            CHECK(error.code() == ErrorCode::interrupted);
            CHECK_FALSE(by_exception);
          } catch (const Stopped&) {
            stopped = true;
            CHECK(by_exception);
          }
          CHECK(stopped);
          progress = {};
          CHECK(bit_differences(results_of(diagram), expected) == "");  // continues
          CHECK(bit_differences(results(diagram), expected) == "");     // starts again
          CHECK(shim::alive() == before);
        }
    }
}
