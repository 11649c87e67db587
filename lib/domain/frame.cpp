#include "lib/domain/frame.hpp"

#include <algorithm>
#include <cstring>

#include "lib/base/threads.hpp"

namespace powercell {
namespace {

constexpr std::size_t least_shared = 16384;  // points; fewer are faster on one thread

}  // namespace

Frame Frame::of(const RegionMesh& mesh, bool float32) {
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, mesh.high[k] - mesh.low[k]);
  Frame frame;
  int exponent = 0;
  std::frexp(extent, &exponent);
  frame.scale = std::ldexp(1.0, -exponent);
  frame.split = float32;
  if (float32)
    for (std::size_t k = 0; k < 3; ++k) frame.centre[k] = mesh.low[k] + (mesh.high[k] - mesh.low[k]) / 2;
  return frame;
}

std::vector<std::byte> Frame::pack(int dimension, std::span<const double> positions,
                                   std::span<const double> weights) const {
  const std::size_t count = dimension == 0 ? 0 : positions.size() / static_cast<std::size_t>(dimension);
  std::vector<std::byte> packed(count * point_bytes);
  pack_to(packed.data(), dimension, positions, weights, 1);
  return packed;
}

void Frame::pack_to(std::byte* to, int dimension, std::span<const double> positions,
                    std::span<const double> weights, int threads) const {
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t count = d == 0 ? 0 : positions.size() / d;
  parallel_for(threads_for(count, threads, least_shared), count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double value[4] = {0, 0, 0, weights.empty() ? 0 : weight_to_device(weights[i])};
      for (std::size_t k = 0; k < d; ++k) value[k] = to_device(positions[i * d + k], static_cast<int>(k));
      if (!split) {
        std::memcpy(to + i * point_bytes, value, point_bytes);
        continue;
      }
      float halves[8];
      for (int k = 0; k < 4; ++k) {
        halves[k] = static_cast<float>(value[k]);
        halves[4 + k] = static_cast<float>(value[k] - static_cast<double>(halves[k]));
      }
      std::memcpy(to + i * point_bytes, halves, point_bytes);
    }
  });
}

}  // namespace powercell
