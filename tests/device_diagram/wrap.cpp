// Seeds wrapped into periodic domains on the device and on the host.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "kernels/layout.h"
#include "lib/diagram/setup.hpp"
#include "lib/scene/variant.hpp"
#include "lib/seeds/device_seeds.hpp"
#include "tests/device_diagram/caller.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Seeds on and within rounding of borders, between quanta, near and far.
SeedArray awkward_seeds(const Domain& domain, std::size_t n, Random& random) {
  const int d = domain.dimension();
  SeedArray seeds{d, {}, std::vector<double>(n)};
  const auto periods = domain.periods();
  const std::array<double, 3> low = domain.low();
  for (std::size_t i = 0; i < n; ++i) {
    std::array<double, 3> x{};
    const std::size_t kind = random.index(6);
    for (std::size_t c = 0; c < 3; ++c) x[c] = kind < 4 ? 0 : random.uniform(-1, 2);
    if (kind == 3)
      x[random.index(3)] = std::ldexp(random.uniform(-1, 1), -static_cast<int>(random.index(70)));
    for (std::size_t k = 0; k < 3; ++k) {
      double times = static_cast<double>(random.index(7)) - 3;
      if (kind == 1)
        times = std::floor(std::ldexp(random.uniform(-1, 1), static_cast<int>(random.index(25))));
      if (kind == 2) times /= 4;
      for (std::size_t c = 0; c < 3; ++c) x[c] += times * periods[k][c];
    }
    for (std::size_t c = 0; c < static_cast<std::size_t>(d); ++c) {
      double y = x[c] + low[c];
      if (random.index(8) == 0) y = std::nextafter(y, random.uniform(-9, 9));
      seeds.positions.push_back(y);
    }
  }
  return seeds;
}

/// The wrapped point is in the domain, and an image of the seed to half a quantum.
void check_host(const Domain& domain, const SeedArray& seeds) {
  const Period& period = *domain.mesh().period;
  const auto d = static_cast<std::size_t>(seeds.dimension);
  double longest = 0, least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < period.count(); ++k) least = std::min(least, period.spacing(k));
  for (int k = 0; k < 3; ++k)
    for (const double x : period.given(k)) longest = std::max(longest, std::fabs(x));
  std::size_t outside = 0, moved = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Period::Wrapped at = period.wrap(&seeds.positions[i * d]);
    if (at.is_far) continue;
    const Period::Coordinates f = period.fraction(at.position.data());
    for (int k = 0; k < period.count(); ++k)
      outside += !(f[static_cast<std::size_t>(k)] >= -2e-9 && f[static_cast<std::size_t>(k)] <= 1 + 2e-9);
    for (std::size_t c = 0; c < d; ++c) {
      long double there = at.position[c], times = 1, size = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const long double v = period.given(static_cast<int>(k))[c];
        there += at.shift[k] * v;
        // In the reduced basis there may be as many more as it is shorter.
        times += 8 * longest / least * std::fabs(static_cast<long double>(at.shift[k]));
        size += std::fabs(at.shift[k] * v);
      }
      // Vectors that are no multiples of the quantum are off by half of one each time.
      const long double off = times * period.quantum()[c] / 2 + 0x1p-60L * size;
      moved += !(std::fabs(there - static_cast<long double>(seeds.positions[i * d + c])) <= off);
    }
  }
  CHECK(outside == 0);
  CHECK(moved == 0);
}

/// What the device makes of seeds.
struct Wrapped {
  std::vector<double> coordinates;  ///< n x 4 in the frame, the sums of both parts
  std::vector<std::int32_t> shift;
  std::vector<cl_uint> status;
};

std::vector<double> sums_of_parts(const std::vector<double>& words, bool float32) {
  if (!float32) return words;
  std::vector<float> halves(words.size() * 2);
  std::memcpy(halves.data(), words.data(), words.size() * sizeof(double));
  std::vector<double> sums;
  for (std::size_t i = 0; i < halves.size(); i += 8)
    for (std::size_t k = i; k < i + 4; ++k) sums.push_back(double{halves[k]} + double{halves[k + 4]});
  return sums;
}

template <class Real>
Wrapped wrap_on_device(Caller& caller, const Domain& domain, const Frame& frame, const SeedArray& seeds) {
  const int d = domain.dimension();
  const auto n = static_cast<std::uint32_t>(seeds.size());
  DeviceWrap wrap(caller.device().context(), Variant{d, d, frame.split, {1, 1}}.defines(),
                  *domain.mesh().period, frame);
  std::array<Real, FRAME_SIZE> numbers{};
  for (std::size_t k = 0; k < 3; ++k) {
    numbers[FRAME_CENTRE + k] = static_cast<Real>(frame.centre[k]);
    numbers[FRAME_CENTRE_LOW + k] =
        static_cast<Real>(frame.centre[k] - static_cast<double>(numbers[FRAME_CENTRE + k]));
  }
  numbers[FRAME_SCALE] = static_cast<Real>(frame.scale);
  const std::vector<Real> values(seeds.positions.begin(), seeds.positions.end());
  const Memory frame_memory(caller, sizeof numbers, numbers.data());
  const Memory positions(caller, values.size() * sizeof(Real), values.data());
  const Memory packed(caller, n * Frame::point_bytes), status(caller, n * sizeof(cl_uint));
  wrap.enqueue(frame_memory.handle(), positions.handle(), nullptr, n, packed.handle(), status.handle());
  const std::size_t words = n * Frame::point_bytes / sizeof(double);
  return {sums_of_parts(packed.values<double>(caller.queue(), words), frame.split), wrap.shift.download(),
          status.values<cl_uint>(caller.queue(), n)};
}

void check_device(Caller& caller, const Domain& domain, const SeedArray& seeds, bool float32) {
  const Period& period = *domain.mesh().period;
  const auto d = static_cast<std::size_t>(seeds.dimension);
  const Frame frame = Frame::of(*clip_mesh_of(domain), float32);
  const Wrapped found = float32 ? wrap_on_device<float>(caller, domain, frame, seeds)
                                : wrap_on_device<double>(caller, domain, frame, seeds);
  std::size_t different = 0, shifted = 0, far = 0, not_far = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Period::Wrapped at = period.wrap(&seeds.positions[i * d]);
    not_far += at.is_far != (found.status[i] == SEED_INVALID);
    far += at.is_far;
    if (at.is_far) continue;
    const std::vector<std::byte> bytes = frame.pack(static_cast<int>(d), std::span(at.position).first(d), {});
    std::vector<double> words(4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    const std::vector<double> expected = sums_of_parts(words, float32);
    for (std::size_t c = 0; c < d; ++c)
      different += period.quantum()[c] > 0 && found.coordinates[4 * i + c] != expected[c];
    for (std::size_t k = 0; k < 3; ++k) shifted += at.shift[k] != found.shift[3 * i + k];
  }
  CHECK(different == 0);
  CHECK(shifted == 0);
  CHECK(not_far == 0);
  CHECK(far < seeds.size() / 4);
}

}  // namespace

TEST_CASE("device and host wrap seeds to the same places, bit by bit") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  std::vector<NamedDomain> domains = periodic_domains();
  const double far_low[] = {1e9, -1e7}, far_high[] = {1e9 + 1, -1e7 + 0.3};
  domains.push_back({"far", Domain::periodic_box(far_low, far_high)});
  const double long_low[] = {0, 0, 0}, long_high[] = {1, 9e5, 3};
  domains.push_back({"long", Domain::periodic_box(long_low, long_high)});
  const double long_vectors[] = {1, 0, 0, 0.3, 2, 0, 1e5, 3e5, 7e5};
  domains.push_back({"long lattice", Domain::lattice(long_vectors)});
  for (const Precision precision : precisions(caller))
    for (const NamedDomain& domain : domains) {
      CAPTURE(domain.name);
      CAPTURE(static_cast<int>(precision));
      const SeedArray seeds = rounded_seeds(awkward_seeds(domain.domain, 4000, random), precision);
      check_host(domain.domain, seeds);
      check_device(caller, domain.domain, seeds, precision == Precision::float32);
    }
}
