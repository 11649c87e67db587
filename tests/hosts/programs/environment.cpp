// usage: host_environment MODE WHEN: a host whose thread rounds or flushes or traps as MODE says (near, up,
// down, zero, flush, trap), from the beginning or after it has opened a device (WHEN: first, late). Prints a
// hash of all results of each job; ends with 3 if its environment was changed.
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <powercell/powercell.hpp>
#include <string_view>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

using namespace powercell;

namespace {

std::uint64_t state = 1;
double unit() {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return static_cast<double>(state >> 11) * 0x1p-53;
}
std::vector<double> units(std::size_t count, double size = 1) {
  std::vector<double> all(count);
  for (double& x : all) x = size * unit();
  return all;
}

class Hash {
 public:
  template <class T>
  Hash& add(const std::vector<T>& values) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t k = 0; k < values.size() * sizeof(T); ++k) value_ = (value_ ^ bytes[k]) * 0x100000001b3u;
    return *this;
  }
  unsigned long long value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

void job(const char* name, const Device& device, const Domain& domain, const std::vector<double>& positions,
         const std::vector<double>& weights = {}, Precision precision = Precision::automatic) {
  Options options;
  options.precision = precision;
  Diagram diagram(device, domain, options);
  diagram.set_seeds({domain.dimension(), positions, weights});
  const Adjacency& walls = diagram.adjacency();
  const Measures& cells = diagram.measures();
  const Hash hash = Hash()
                        .add(walls.offset)
                        .add(walls.neighbor)
                        .add(walls.wall)
                        .add(cells.status)
                        .add(cells.mass)
                        .add(cells.second_moment);
  std::printf("%s %016llx, domain %a, sum %a\n", name, hash.value(), cells.domain_measure, cells.total());
}

void set(std::string_view mode) {
  if (mode == "up") std::fesetround(FE_UPWARD);
  if (mode == "down") std::fesetround(FE_DOWNWARD);
  if (mode == "zero") std::fesetround(FE_TOWARDZERO);
#if defined(__SSE2__)
  if (mode == "flush") _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
#if defined(__GLIBC__)
  if (mode == "trap") feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#endif
}

/// All settings, without the flags of exceptions that were raised.
unsigned long settings() {
  unsigned long all = static_cast<unsigned long>(std::fegetround());
#if defined(__SSE2__)
  all |= static_cast<unsigned long>(_mm_getcsr() & 0xffc0) << 32;
#endif
#if defined(__GLIBC__)
  all |= static_cast<unsigned long>(fegetexcept()) << 16;
#endif
  return all;
}

}  // namespace

int main(int, char** argv) try {
  const std::string_view mode = argv[1];
  const bool late = std::strcmp(argv[2], "late") == 0;
  std::vector<double> lattice;
  for (int k = 0; k < 343; ++k)
    for (const int step : {k / 49, k / 7 % 7, k % 7}) lattice.push_back(0.1 + step / 8.0);
  std::vector<double> on_sphere;
  for (int k = 0; k < 200; ++k) {
    const double x = unit() - 0.5, y = unit() - 0.5, z = unit() - 0.5, r = std::sqrt(x * x + y * y + z * z);
    for (const double c : {x, y, z}) on_sphere.push_back(0.5 + 0.4 * c / r);
  }
  const std::vector<double> white = units(3000), tiny = units(600, 1e-99), weights = units(200, 0.05);
  const std::vector<double> low(3, 0), high(3, 1), least(3, 1e-99);
  const Ring ring = {{0, 0}, {1, 0.1}, {0.9, 1}, {0.1, 0.7}};

  if (!late) set(mode);
  const Device device = Device::choose();
  if (late) set(mode);
  const unsigned long before = settings();
  const Domain box = Domain::box(low, high),
               square = Domain::box(std::span(low).first(2), std::span(high).first(2));
  job("white", device, box, white);
  job("white in float", device, box, white, {}, Precision::float32);
  job("lattice", device, box, lattice);
  job("sphere", device, box, on_sphere, weights);
  job("tiny", device, Domain::box(low, least), tiny);
  job("square", device, square, units(2000));
  job("periodic", device, Domain::periodic_box(low, high), white);
  const PolygonPart part{ring, {}};
  job("polygon", device, Domain::polygon({&part, 1}), units(400));
  return settings() == before ? 0 : 3;
} catch (const Error& error) {
  std::printf("%s: %s\n", name(error.code()), error.what());
  return 2;
}
