#include "lib/neighbors/list_candidates.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <powercell/error.hpp>
#include <string>

#include "kernels/layout.h"
#include "lib/base/text.hpp"
#include "lib/base/threads.hpp"

namespace powercell {

namespace {

/// Maximum number of list entries in device memory at once.
constexpr std::size_t most_entries = std::size_t{1} << 25;

std::size_t initial_neighbors(const Options& options, int cell_dimension) {
  if (options.initial_neighbors > 0) return static_cast<std::size_t>(options.initial_neighbors);
  return cell_dimension == 3 ? 32 : 16;
}

[[noreturn]] void refuse_lift(double eta, const std::string& why) {
  throw Error(ErrorCode::invalid_argument, "the height of the lift, " + digits(eta) + ", is " + why +
                                               "; leave it unset to use the largest weight");
}

/// The lift of weighted seeds to unweighted points one dimension up (paper, section 3): h_i = sqrt(eta - w_i)
/// by rank, in units of the frame; eta = NaN means the largest weight.
/// \throw Error invalid_argument if eta is below the largest weight or above Frame::most_weight
std::vector<double> lift_heights(const SeedSet& seeds, double eta, const Frame& frame) {
  std::vector<double> heights(seeds.size());
  if (heights.empty()) return heights;
  const double largest = *std::max_element(seeds.weights.begin(), seeds.weights.end());
  if (std::isnan(eta)) eta = largest;
  if (!(eta >= largest)) refuse_lift(eta, "below the largest weight, " + digits(largest));
  const double top = frame.weight_to_device(eta);
  // Above it, distances between lifted seeds are infinite and the lists hold arbitrary seeds.
  if (!(top <= frame.most_weight()))
    refuse_lift(eta, "too large for the size of the domain: its square would not be finite");
  std::transform(seeds.weights.begin(), seeds.weights.end(), heights.begin(),
                 [&](double w) { return std::sqrt(top - frame.weight_to_device(w)); });
  return heights;
}

}  // namespace

ListCandidates::ListCandidates(const Scene& scene, const Options& options)
    : ListCandidates(scene, options, lift_heights(scene.seeds, options.lift_eta, scene.frame())) {}

ListCandidates::ListCandidates(const Scene& scene, const Options& options, const std::vector<double>& heights)
    : scene_(scene),
      initial_(initial_neighbors(options, scene.mesh().cell_dimension)),
      twins_(options.twin_queries),
      threads_(thread_count(options.threads)),
      index_(std::make_shared<Index>(scene.seeds, scene.frame().scale, heights)),
      lift_(scene.context()),
      neighbor_(scene.context()),
      active_list_(scene.context()),
      list_use_(scene.context()) {
  if (scene.float32()) {
    const std::vector<float> narrow(heights.begin(), heights.end());
    lift_.reserve(narrow.size() * sizeof(float));
    if (!narrow.empty()) lift_.write(narrow.data(), narrow.size() * sizeof(float));
  } else {
    lift_.reserve(heights.size() * sizeof(double));
    if (!heights.empty()) lift_.write(heights.data(), heights.size() * sizeof(double));
  }
}

ListCandidates::ListCandidates(const Scene& scene, const ListCandidates& other)
    : scene_(scene),
      initial_(other.initial_),
      twins_(other.twins_),
      threads_(other.threads_),
      index_(other.index_),
      lift_(scene.context()),
      neighbor_(scene.context()),
      active_list_(scene.context()),
      counting_(other.counting_),
      list_use_(scene.context()) {
  std::vector<std::byte> lift(other.lift_.bytes());
  other.lift_.read(lift.data(), lift.size());
  lift_.reserve(lift.size());
  lift_.write(lift.data(), lift.size());
}

std::unique_ptr<Candidates> ListCandidates::on(const Scene& scene) const {
  return std::unique_ptr<Candidates>(new ListCandidates(scene, *this));
}

std::size_t ListCandidates::neighbors(int round) const {
  const std::size_t others = scene_.seeds.size() - 1;
  return round > 40 ? others : std::min(others, initial_ << round);
}

std::size_t ListCandidates::most_pairs(int round) const {
  return std::max<std::size_t>(1, most_entries / std::max<std::size_t>(1, neighbors(round)));
}

std::unique_ptr<Candidates> ListCandidates::for_scene(const Scene& scene) const {
  auto other = std::make_unique<ListCandidates>(scene, Options{});
  other->counting_ = counting_;
  return other;
}

int ListCandidates::outputs() const {
  return counting_ ? OUTPUT_LIST_USE : 0;
}

void ListCandidates::read_use() {
  if (launched_rows_ == 0) return;
  std::vector<std::uint32_t> rows(launched_rows_ * 3);
  list_use_.download(std::span(rows));
  const auto round = static_cast<std::size_t>(launched_round_);
  if (use_.pairs_per_round.size() <= round) use_.pairs_per_round.resize(round + 1);
  for (std::size_t row = 0; row < rows.size(); row += 3) {
    if (rows[row + 2] == 0) continue;
    use_.tried += rows[row];
    use_.cuts += rows[row + 1];
    ++use_.pairs;
    ++use_.pairs_per_round[round];
  }
  launched_rows_ = 0;
}

const ListUse& ListCandidates::use() {
  read_use();
  return use_;
}

void ListCandidates::prepare(std::span<const std::uint32_t> ranks, int round) {
  read_use();
  const auto start = std::chrono::steady_clock::now();
  distinct_.clear();
  pair_row_.clear();
  for (const std::uint32_t rank : ranks) {
    if (distinct_.empty() || distinct_.back() != rank) distinct_.push_back(rank);
    pair_row_.push_back(static_cast<std::uint32_t>(distinct_.size() - 1));
  }
  count_ = neighbors(round);
  {
    const std::scoped_lock lock(index_->querying);
    index_->tree.query(distinct_, count_, twins_, threads_, rows_);
  }
  host_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  neighbor_.upload(rows_);
  active_list_.upload(pair_row_);
  list_use_.resize(counting_ ? ranks.size() * 3 : 0);
  if (!counting_) return;
  launched_rows_ = ranks.size();
  launched_round_ = round;
  use_.queries += distinct_.size();
  use_.entries += distinct_.size() * count_;
}

void ListCandidates::append_arguments(cl::Kernel& kernel) const {
  kernel.more_args(scene_.buffers.points, static_cast<cl_uint>(scene_.seeds.size()), lift_, neighbor_,
                   active_list_, static_cast<cl_uint>(count_), static_cast<cl_uint>(count_),
                   static_cast<cl_int>(twins_), list_use_);
}

}  // namespace powercell
