#include <powercell/c/verify.h>

#include <memory>
#include <powercell/verify.hpp>

#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

struct Checks {
  std::vector<LawCheck> laws;
  std::vector<pc_law_check> views;
  std::vector<const pc_law_check*> pointers;
};

pc_verify_options defaults() {
  const VerifyOptions from;
  pc_verify_options to{};
  to.samples = from.samples;
  to.random_seed = from.random_seed;
  return to;
}

void fill(pc_law_checks& to, Checks& from) {
  to.passed = 1;
  for (const LawCheck& law : from.laws) {
    from.views.push_back({law.law.c_str(), law.passed, law.value, law.tolerance, law.detail.c_str()});
    if (!law.passed) to.passed = 0;
  }
  from.pointers = pointers(from.views);
  to.count = from.pointers.size();
  to.checks = pointer(from.pointers);
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_verify_options_init(pc_verify_options* options, size_t struct_size) {
  return init(options, struct_size, defaults(), "pc_verify_options");
}

pc_status pc_diagram_verify(pc_diagram* diagram, const double* positions, const double* weights, size_t count,
                            const pc_verify_options* options, const pc_law_checks** checks) {
  return guarded([&] {
    result_at(checks);
    Diagram& of = diagram_in(diagram);
    const pc_verify_options given = current(options, defaults(), "pc_verify_options");
    VerifyOptions with;
    with.samples = given.samples;
    with.random_seed = given.random_seed;
    with.progress = progress_of(given.progress, given.progress_user);
    const SeedsView seeds = seeds_of(of.domain().dimension(), positions, weights, count);
    hand_over_result(checks, Checks{verify(of, seeds, with), {}, {}}, fill);
  });
}

void pc_law_checks_destroy(const pc_law_checks* checks) {
  destroy_result<Checks>(checks);
}

}  // extern "C"
