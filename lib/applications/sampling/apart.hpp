/// \file
/// Parts of cells that are apart from their points.
#pragma once

#include <cstddef>
#include <functional>
#include <powercell/sampling.hpp>
#include <span>
#include <vector>

#include "lib/base/vectors.hpp"

namespace powercell {

/// Measure, and integral of the position.
struct Moment {
  double measure = 0;
  Vector3<double> first{};
  void add(double size, const Vector3<double>& centroid) {
    measure += size;
    first = first + size * centroid;
  }
  void add(const Moment& other) {
    measure += other.measure;
    first = first + other.first;
  }
};

/// Counts the parts of cells that are apart from their points.
class PartsTally {
 public:
  /// \param whole  the measure of all cells, which are n
  PartsTally(double whole, std::size_t n);
  /// \param parts  of one cell, and the distance of a part from a place
  void add_cell(std::span<const Moment> parts, const Vector3<double>& point,
                const std::function<double(std::size_t part, const Vector3<double>& place)>& distance);
  PartsApart result();

 private:
  /// A part apart from its point.
  struct Apart {
    double distance, measure;
  };
  double whole_, least_;
  PartsApart result_;
  std::vector<Apart> apart_;
};

/// Finds the connected parts of each cell: pieces that share a facet between regions of the domain.
/// \param positions  n x d: the points of the cells
PartsApart parts_apart(const Cells& cells, std::span<const double> positions);

}  // namespace powercell
