#include "lib/c_api/options.hpp"

namespace powercell::c_api {
namespace {

static_assert(static_cast<int>(Precision::float32) == PC_FLOAT32);
static_assert(static_cast<int>(Neighbors::flann) == PC_FLANN);
static_assert(static_cast<int>(Decisions::fast) == PC_DECISIONS_FAST);

pc_options defaults() {
  const Options from;
  pc_options to{};
  to.twin_queries = from.twin_queries;
  to.lift_eta = from.lift_eta;
  return to;
}

}  // namespace

Options options_of(const pc_options* options) {
  const pc_options from = current(options, defaults(), "pc_options");
  Options to;
  to.precision = value_of<Precision>(from.precision, PC_FLOAT32, "options.precision", "pc_precision");
  to.neighbors = value_of<Neighbors>(from.neighbors, PC_FLANN, "options.neighbors", "pc_neighbors");
  to.decisions = value_of<Decisions>(from.decisions, PC_DECISIONS_FAST, "options.decisions", "pc_decisions");
  to.certify = from.certify != 0;
  to.initial_neighbors = from.initial_neighbors;
  to.lift_eta = from.lift_eta;
  to.twin_queries = from.twin_queries != 0;
  to.threads = from.threads;
  to.chunk_pairs = from.chunk_pairs;
  to.progress = progress_of(from.progress, from.progress_user);
  return to;
}

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

pc_status pc_options_init(pc_options* options, size_t struct_size) {
  return init(options, struct_size, defaults(), "pc_options");
}
