/// \file
/// Whether a box lies in a region.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "lib/base/vectors.hpp"
#include "lib/domain/region_mesh.hpp"
#include "lib/pairs/part.hpp"

namespace powercell::pairs {

/// The interior of one region, relative to its first corner. It only decides which seeds become candidates
/// without a test, so it need not be exact.
template <int D>
class RegionInterior {
 public:
  void set(const std::vector<Point<D>>& corners, const RegionMesh& mesh) {
    corners_ = &corners;
    shape_ = mesh.shape;
    solid_ = mesh.cell_dimension == D;
    ready_ = false;
    low_.fill(std::numeric_limits<double>::infinity());
    high_.fill(-std::numeric_limits<double>::infinity());
    for (const Point<D>& c : corners)
      for (std::size_t k = 0; k < D; ++k) {
        low_[k] = std::min(low_[k], c[k]);
        high_[k] = std::max(high_[k], c[k]);
      }
  }

  bool contains(const Point<D>& low, const Point<D>& high) {
    if (!solid_) return false;
    for (std::size_t k = 0; k < D; ++k)
      if (!(low[k] >= low_[k] && high[k] <= high_[k])) return false;
    if (shape_ == RegionShape::box) return true;
    if (!ready_) make_half_spaces();
    return std::all_of(half_spaces_.begin(), half_spaces_.end(), [&](const HalfSpace& h) {
      double value = h.offset;  // at the corner of the box farthest along the outward normal
      for (std::size_t k = 0; k < D; ++k) value += std::min(h.normal[k] * low[k], h.normal[k] * high[k]);
      return value >= 0;
    });
  }

 private:
  struct HalfSpace {
    Point<D> normal;  // inwards
    double offset;
  };

  // Made on first use: most regions of a fine mesh never contain a node.
  void make_half_spaces() {
    ready_ = true;
    half_spaces_.clear();
    const std::vector<Point<D>>& c = *corners_;
    if constexpr (D == 2) {
      for (std::size_t k = 0; k < c.size(); ++k) {
        const Point<D>& a = c[k];
        const Point<D>& b = c[(k + 1) % c.size()];
        add({a[1] - b[1], b[0] - a[0]}, a);
      }
    } else {
      for (std::size_t k = 0; k < 4; ++k) {
        const Point<D>& a = c[(k + 1) % 4];
        const Point<D>& b = c[(k + 2) % 4];
        const Point<D>& e = c[(k + 3) % 4];
        Point<D> normal = cross(b - a, e - a);
        if (dot(normal, c[k] - a) < 0)  // the corner opposite the face
          for (double& x : normal) x = -x;
        add(normal, a);
      }
    }
  }
  void add(const Point<D>& normal, const Point<D>& on) {
    double offset = 0;
    for (std::size_t k = 0; k < D; ++k) offset -= normal[k] * on[k];
    half_spaces_.push_back({normal, offset});
  }

  const std::vector<Point<D>>* corners_ = nullptr;
  RegionShape shape_ = RegionShape::polygon;
  bool solid_ = false, ready_ = false;
  Point<D> low_{}, high_{};
  std::vector<HalfSpace> half_spaces_;
};

}  // namespace powercell::pairs
