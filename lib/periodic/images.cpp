#include "lib/periodic/images.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/error.hpp>
#include <powercell/seeds.hpp>
#include <string>

#include "lib/base/threads.hpp"
#include "lib/seeds/hilbert.hpp"

namespace powercell {
namespace {

constexpr double margin_steps = 8;  ///< of a first margin while it doubles
/// More than the rounding of fractions.
constexpr double fraction_rounding = 1e-6;
/// More than the rounding of the distances compared, relative.
constexpr double proof_rounding = 1e-6;

/// Whether a margin is as wide as the images of the Voronoi cell along vector k, so that no image is missing
/// there.
bool is_complete(const Period& period, int k, double margin) {
  return margin / period.spacing(k) >= period.reach(k);
}

/// The margin along each vector, in fractions.
std::array<double, 3> margins(const Period& period, double margin) {
  std::array<double, 3> along{};
  for (int k = 0; k < period.count(); ++k)
    along[static_cast<std::size_t>(k)] =
        std::min(margin / period.spacing(k), period.reach(k)) + fraction_rounding;
  return along;
}

/// The shifts of the images of one seed within a margin, itself among them.
struct ShiftRange {
  Shift low{}, high{};

  /// \param f  the seed's fractions
  /// \param margin  along each vector; below 0 the range is empty
  ShiftRange(const Period& period, const Period::Coordinates& f, const std::array<double, 3>& margin) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(period.count()); ++k) {
      low[k] = static_cast<std::int32_t>(std::ceil(-margin[k] - f[k]));
      high[k] = static_cast<std::int32_t>(std::floor(1 + margin[k] - f[k]));
    }
  }
  bool contains(const Shift& s) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (s[k] < low[k] || s[k] > high[k]) return false;
    return true;
  }
  template <class Use>
  void for_each(const Use& use) const {
    Shift s;
    for (s[0] = low[0]; s[0] <= high[0]; ++s[0])
      for (s[1] = low[1]; s[1] <= high[1]; ++s[1])
        for (s[2] = low[2]; s[2] <= high[2]; ++s[2]) use(s);
  }
};

/// A linear function with different values for the shifts of images, whose components are small.
std::int32_t code_of(const Shift& shift) {
  constexpr std::int32_t step = 64;
  return (shift[0] * step + shift[1]) * step + shift[2];
}

void check_count(std::size_t count) {
  if (count > most_seeds_of_diagram)
    throw Error(ErrorCode::unsupported, "the seeds and their images in the periodic domain are more than " +
                                            std::to_string(most_seeds_of_diagram) + "; use fewer seeds");
}

/// Appends further images to `images.seeds` along a Hilbert curve.
void append_sorted(Images& images, std::span<const double> positions, std::span<const std::uint32_t> rank,
                   std::span<const Shift> shift, int threads) {
  SeedSet& all = images.seeds;
  const auto d = static_cast<std::size_t>(all.dimension);
  const std::vector<std::uint32_t> order = hilbert_order(positions, all.dimension, threads);
  const std::size_t first = all.size(), before = first - images.own, count = order.size();
  all.positions.resize((first + count) * d);
  all.weights.resize(first + count);
  all.input.resize(first + count);
  images.rank.resize(before + count);
  images.shift.resize(before + count);
  images.code.resize(before + count);
  parallel_for(threads_for(count, threads), count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t from = order[k];
      std::copy_n(&positions[from * d], d, &all.positions[(first + k) * d]);
      all.weights[first + k] = all.weights[rank[from]];
      all.input[first + k] = all.input[rank[from]];
      images.rank[before + k] = rank[from];
      images.shift[before + k] = shift[from];
      images.code[before + k] = code_of(shift[from]);
    }
  });
}

/// Appends the images of each seed within a margin, margin_of(seed), without those that it has.
template <class MarginOf>
void append_within(Images& images, const Period& period, const MarginOf& margin_of, int threads) {
  const auto d = static_cast<std::size_t>(images.seeds.dimension);
  const bool has_images = images.margin > 0;
  std::vector<double> positions;
  std::vector<std::uint32_t> rank;
  std::vector<Shift> shift;
  for (std::uint32_t r = 0; r < images.own; ++r) {
    if (has_images && margin_of(r) <= images.margin_of(r)) continue;
    const double* const x = &images.seeds.positions[r * d];
    const Period::Coordinates f = period.fraction(x);
    const ShiftRange old(period, f, margins(period, images.margin_of(r)));
    ShiftRange(period, f, margins(period, margin_of(r))).for_each([&](const Shift& s) {
      if (s == Shift{} || (has_images && old.contains(s))) return;
      const Period::Coordinates y = period.moved(x, s);
      positions.insert(positions.end(), y.begin(), y.begin() + static_cast<std::ptrdiff_t>(d));
      rank.push_back(r);
      shift.push_back(s);
    });
    check_count(images.seeds.size() + rank.size());
  }
  append_sorted(images, positions, rank, shift, threads);
}

}  // namespace

double first_margin(const Period& period, const SeedSet& seeds) {
  if (seeds.size() == 0) return 0;
  const auto n = static_cast<double>(seeds.size());
  const double spacing = std::pow(period.measure() / n, 1.0 / period.dimension());
  // The volume, in those of a mean cell, of the largest ball without seeds is about the logarithm of their
  // number.
  const double ball = std::log(n) + 6;
  const double reach = spacing * (period.dimension() == 2 ? std::sqrt(ball / 3.14) : std::cbrt(ball / 4.19));
  const double most = *std::max_element(seeds.weights.begin(), seeds.weights.end());
  const double mean = std::accumulate(seeds.weights.begin(), seeds.weights.end(), 0.0) / n;
  const double margin = reach + std::sqrt(reach * reach + std::min(1.5 * (most - mean), 2 * reach * reach));
  // In steps, so that new weights mostly need the same images.
  return std::exp2(std::ceil(margin_steps * std::log2(margin)) / margin_steps);
}

double complete_margin(const Period& period) {
  double margin = 0;
  for (int k = 0; k < period.count(); ++k) margin = std::max(margin, period.reach(k) * period.spacing(k));
  return (1 + fraction_rounding) * margin;
}

Images make_images(const Period& period, const SeedSet& seeds, double margin, int threads) {
  Images images;
  images.seeds = seeds;
  images.own = static_cast<std::uint32_t>(seeds.size());
  append_within(
      images, period, [&](std::uint32_t) { return margin; }, threads);
  images.margin = margin;
  return images;
}

void widen(Images& images, const Period& period, double margin, std::span<const double> clearance,
           int threads) {
  std::vector<double> next(images.own);
  for (std::uint32_t r = 0; r < images.own; ++r)
    next[r] = std::max(images.margin_of(r), std::min(margin, clearance[r]));
  append_within(
      images, period, [&](std::uint32_t r) { return next[r]; }, threads);
  images.margin = margin;
  images.seed_margin = std::move(next);
}

void set_weights(Images& images, const SeedSet& seeds, int threads) {
  const std::size_t count = images.seeds.size();
  parallel_for(threads_for(count, threads), count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      images.seeds.weights[r] = seeds.weights[images.seed_of(static_cast<std::uint32_t>(r))];
  });
}

Images without_hidden(const Images& images, const std::vector<std::uint8_t>& hidden) {
  const auto d = static_cast<std::size_t>(images.seeds.dimension);
  Images kept;
  kept.margin = images.margin;
  kept.seeds.dimension = images.seeds.dimension;
  kept.seeds.input_count = images.seeds.input_count;
  kept.seeds.duplicate = images.seeds.duplicate;
  std::vector<std::uint32_t> new_rank(images.own);
  for (std::uint32_t r = 0; r < images.seeds.size(); ++r) {
    const std::uint32_t seed = images.seed_of(r);
    if (hidden[seed] != 0) continue;
    if (r < images.own) {
      new_rank[r] = kept.own++;
    } else {
      kept.rank.push_back(new_rank[seed]);
      kept.shift.push_back(images.shift_of(r));
      kept.code.push_back(images.code[r - images.own]);
    }
    kept.seeds.input.push_back(images.seeds.input[r]);
    kept.seeds.weights.push_back(images.seeds.weights[r]);
    kept.seeds.positions.insert(kept.seeds.positions.end(), &images.seeds.positions[r * d],
                                &images.seeds.positions[r * d] + d);
  }
  return kept;
}

MarginProof::MarginProof(const Period& period, const Images& images, double reach_error)
    : period_(period),
      images_(images),
      most_weight_(images.own == 0 ? 0
                                   : *std::max_element(images.seeds.weights.begin(),
                                                       images.seeds.weights.begin() + images.own)),
      factor_((1 + reach_error) * (1 + proof_rounding)) {}

double MarginProof::clearance(std::uint32_t rank, double reach) const {
  const double excess = std::max(most_weight_ - images_.seeds.weights[rank], 0.0);
  return factor_ * (reach + std::sqrt(reach * reach + excess));  // (34b)
}

double MarginProof::margin_for(std::uint32_t rank, double clearance) const {
  const Period::Coordinates f =
      period_.fraction(&images_.seeds.positions[rank * static_cast<std::size_t>(images_.seeds.dimension)]);
  double needed = 0;
  for (int k = 0; k < period_.count(); ++k) {
    if (is_complete(period_, k, images_.margin)) continue;
    const double x = f[static_cast<std::size_t>(k)];
    needed = std::max(needed, clearance - std::min(x, 1 - x) * period_.spacing(k));
  }
  return needed <= images_.margin ? 0 : needed;
}

Shift Placement::shift_of_wall(std::uint32_t rank, std::uint32_t neighbor) const {
  const std::array<std::int64_t, 3> between = period.as_given(images.shift_of(neighbor));
  const Shift &here = wrapped[images.seeds.input[rank]], &there = wrapped[images.seeds.input[neighbor]];
  Shift shift{};
  for (std::size_t k = 0; k < 3; ++k) shift[k] = static_cast<std::int32_t>(between[k] + here[k] - there[k]);
  return shift;
}

}  // namespace powercell
