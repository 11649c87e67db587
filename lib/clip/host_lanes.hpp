// The names of kernels/base/lanes.cl for the host: eight lanes as an array. Included inside the namespace of
// a host clipper, where `real`, `stored_real` and `uint` are known.

using ulong = unsigned long;
struct real8 {
  real lane[LANES];
};
struct mask8 {
  bool lane[LANES];
};

template <class Result, class Body>
inline Result each_lane(const Body& body) {
  Result result;
  for (int k = 0; k < LANES; ++k) result.lane[k] = body(k);
  return result;
}

inline real8 all_lanes(real x) {
  return each_lane<real8>([&](int) { return x; });
}
#define ZERO8 all_lanes(0)
inline real8 operator+(const real8& a, const real8& b) {
  return each_lane<real8>([&](int k) { return a.lane[k] + b.lane[k]; });
}
inline real8 operator-(const real8& a, const real8& b) {
  return each_lane<real8>([&](int k) { return a.lane[k] - b.lane[k]; });
}
inline real8 operator*(const real8& a, const real8& b) {
  return each_lane<real8>([&](int k) { return a.lane[k] * b.lane[k]; });
}
inline real8 operator/(const real8& a, const real8& b) {
  return each_lane<real8>([&](int k) { return a.lane[k] / b.lane[k]; });
}
inline real8 operator-(const real8& a) {
  return each_lane<real8>([&](int k) { return -a.lane[k]; });
}
inline mask8 operator<(const real8& a, const real8& b) {
  return each_lane<mask8>([&](int k) { return a.lane[k] < b.lane[k]; });
}
inline mask8 operator>(const real8& a, const real8& b) {
  return b < a;
}
inline real8 choose8(const real8& a, const real8& b, const mask8& yes) {
  return each_lane<real8>([&](int k) { return yes.lane[k] ? b.lane[k] : a.lane[k]; });
}
inline real8 least8(const real8& a, const real8& b) {
  return choose8(a, b, b < a);
}
inline real8 most8(const real8& a, const real8& b) {
  return choose8(a, b, a < b);
}
inline real8 size8(const real8& a) {
  return each_lane<real8>([&](int k) { return fabs(a.lane[k]); });
}
inline real least_of(real a, real b) {
  return a < b ? a : b;
}
inline real most_of(real a, real b) {
  return a > b ? a : b;
}
inline real lane_most(const real8& a) {
  return *std::max_element(a.lane, a.lane + LANES);
}
inline real lane_least(const real8& a) {
  return *std::min_element(a.lane, a.lane + LANES);
}
inline uint lane_bits(const mask8& yes) {
  uint bits = 0;
  for (int k = 0; k < LANES; ++k) bits |= yes.lane[k] ? 1U << k : 0U;
  return bits;
}
inline mask8 lanes_of(uint bits) {
  return each_lane<mask8>([&](int k) { return (bits >> k & 1U) != 0; });
}
inline real8 with_lane(real8 a, uint lane, real x) {
  a.lane[lane] = x;
  return a;
}
template <class Number>
inline real8 load8(const Number* at) {
  return each_lane<real8>([&](int k) { return static_cast<real>(at[k]); });
}
inline real8 load8_stored(const stored_real* at) {
  return load8(at);
}
inline void store8(const real8& a, real* at) {
  std::copy(a.lane, a.lane + LANES, at);
}
inline int popcount(ulong bits) {
  return std::popcount(bits);
}
inline int clz(ulong bits) {
  return std::countl_zero(bits);
}

// Tags live in a double's bits: what is tagged only orders candidates.
constexpr ulong tag_mask = 511;
inline ulong key_bits(real a) {
  return std::bit_cast<ulong>(static_cast<double>(std::clamp<real>(a, -1e300L, 1e300L)));
}
inline real8 tag8(const real8& a, uint first) {
  return each_lane<real8>([&](int k) {
    return static_cast<real>(
        std::bit_cast<double>((key_bits(a.lane[k]) & ~tag_mask) | (first + static_cast<uint>(k))));
  });
}
inline uint tag_of(real a) {
  return static_cast<uint>(key_bits(a) & tag_mask);
}
inline real untagged(real a) {
  return static_cast<real>(std::bit_cast<double>(key_bits(a) & ~tag_mask));
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
/* As in OpenCL: the last component is 0. */
inline real4 cross(const real4& a, const real4& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x, 0};
}
inline real dot(const real4& a, const real4& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
