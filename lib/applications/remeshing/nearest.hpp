/// \file
/// The nearest point of a triangle mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/applications/remeshing/vec.hpp"

namespace powercell::remeshing {

/// A tree of boxes over triangles.
class NearestPoint {
 public:
  explicit NearestPoint(std::vector<std::array<Vec, 3>> triangles);
  /// Squared distance of x from the nearest triangle.
  double distance2(Vec x) const;

 private:
  struct Box {
    Vec low, high;
  };
  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0;  ///< triangles below
    std::uint32_t second = 0;          ///< its second child; the first follows it. 0: a leaf
  };
  void build(std::uint32_t begin, std::uint32_t end);
  static double distance2(const Box& box, Vec x);

  std::vector<std::array<Vec, 3>> triangle_;
  std::vector<Node> node_;
};

}  // namespace powercell::remeshing
