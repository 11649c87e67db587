// The names of kernels/base/lanes.cl for the host: eight lanes as an array. Included inside the namespace of
// a host clipper, where `real`, `stored_real` and `uint` are known.

using ulong = unsigned long;
/* As four pairs, which fit the vectors that every processor of 64 bits has: compilers make nothing good of an
 * array. */
typedef real pair_of_reals __attribute__((vector_size(16)));
typedef long long pair_of_masks __attribute__((vector_size(16)));
struct real8 {
  pair_of_reals part[4];
};
struct mask8 {
  pair_of_masks part[4]; /* 0 or -1 */
};

template <class Result, class Body>
inline Result each_part(const Body& body) {
  return {{body(0), body(1), body(2), body(3)}};
}

inline real8 all_lanes(real x) {
  const pair_of_reals both = {x, x};
  return {{both, both, both, both}};
}
#define ZERO8 all_lanes(0)
inline real8 operator+(const real8& a, const real8& b) {
  return each_part<real8>([&](int k) { return a.part[k] + b.part[k]; });
}
inline real8 operator-(const real8& a, const real8& b) {
  return each_part<real8>([&](int k) { return a.part[k] - b.part[k]; });
}
inline real8 operator*(const real8& a, const real8& b) {
  return each_part<real8>([&](int k) { return a.part[k] * b.part[k]; });
}
inline real8 operator/(const real8& a, const real8& b) {
  return each_part<real8>([&](int k) { return a.part[k] / b.part[k]; });
}
inline real8 operator-(const real8& a) {
  return each_part<real8>([&](int k) { return -a.part[k]; });
}
inline mask8 operator<(const real8& a, const real8& b) {
  return each_part<mask8>([&](int k) { return (pair_of_masks)(a.part[k] < b.part[k]); });
}
inline mask8 operator>(const real8& a, const real8& b) {
  return b < a;
}
inline real8 choose8(const real8& a, const real8& b, const mask8& yes) {
  return each_part<real8>([&](int k) {
    return (pair_of_reals)(((pair_of_masks)b.part[k] & yes.part[k]) |
                           ((pair_of_masks)a.part[k] & ~yes.part[k]));
  });
}
inline real8 least8(const real8& a, const real8& b) {
  return each_part<real8>([&](int k) { return b.part[k] < a.part[k] ? b.part[k] : a.part[k]; });
}
inline real8 most8(const real8& a, const real8& b) {
  return each_part<real8>([&](int k) { return a.part[k] < b.part[k] ? b.part[k] : a.part[k]; });
}
inline real8 size8(const real8& a) {
  return each_part<real8>([&](int k) { return (pair_of_reals)((pair_of_masks)a.part[k] & LLONG_MAX); });
}
template <class Two>
inline real over_lanes(const real8& a, const Two& two) {
  const pair_of_reals m = two(two(a.part[0], a.part[1]), two(a.part[2], a.part[3]));
  const pair_of_reals n = {m[1], m[0]};
  return two(m, n)[0];
}
inline real least_of(real a, real b) {
  return a < b ? a : b;
}
inline real most_of(real a, real b) {
  return a > b ? a : b;
}
inline real lane_most(const real8& a) {
  return over_lanes(a, [](pair_of_reals x, pair_of_reals y) { return x < y ? y : x; });
}
inline real lane_least(const real8& a) {
  return over_lanes(a, [](pair_of_reals x, pair_of_reals y) { return y < x ? y : x; });
}
inline real lane_sum(const real8& a) {
  return over_lanes(a, [](pair_of_reals x, pair_of_reals y) { return x + y; });
}
inline uint lane_bits(const mask8& yes) {
  const pair_of_masks first = {1, 2};
  const pair_of_masks bits = (yes.part[0] & first) | (yes.part[1] & (first << 2)) |
                             (yes.part[2] & (first << 4)) | (yes.part[3] & (first << 6));
  return static_cast<uint>(bits[0] | bits[1]);
}
inline mask8 lanes_of(uint bits) {
  const pair_of_masks all = {static_cast<long long>(bits), static_cast<long long>(bits)}, first = {1, 2};
  return each_part<mask8>([&](int k) { return (pair_of_masks)((all & (first << (2 * k))) != 0); });
}
inline void store8(const real8& a, real* at) {
  std::memcpy(at, &a, sizeof a);
}
inline real8 load8(const real* at) {
  real8 a;
  std::memcpy(&a, at, sizeof a);
  return a;
}
inline real8 load8_stored(const stored_real* at) {
  return load8(at);
}
inline real8 with_lane(const real8& a, uint lane, real x) {
  return choose8(a, all_lanes(x), lanes_of(1U << lane));
}
inline int popcount(ulong bits) {
  return std::popcount(bits);
}
inline int clz(ulong bits) {
  return std::countl_zero(bits);
}

// Tags live in the bits of a real: what is tagged only orders candidates, and is within range.
constexpr long long tag_mask = 511;
inline real8 tag8(const real8& a, uint first) {
  const auto start = static_cast<long long>(first);
  return each_part<real8>([&](int k) {
    const pair_of_masks tag = {start + 2 * k, start + 2 * k + 1};
    return (pair_of_reals)(((pair_of_masks)a.part[k] & ~tag_mask) | tag);
  });
}
inline uint tag_of(real a) {
  return static_cast<uint>(std::bit_cast<long long>(a) & tag_mask);
}
inline real untagged(real a) {
  return std::bit_cast<real>(std::bit_cast<long long>(a) & ~tag_mask);
}

struct real4 {
  real x, y, z, w;
};
inline real4 make_real4(real x, real y, real z, real w) {
  return {x, y, z, w};
}
inline real4 operator+(const real4& a, const real4& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}
inline real4 operator-(const real4& a, const real4& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
}
inline real4 operator*(const real4& a, const real4& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w};
}
inline real4 operator*(const real4& a, real b) {
  return {a.x * b, a.y * b, a.z * b, a.w * b};
}
