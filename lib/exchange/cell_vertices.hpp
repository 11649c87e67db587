/// \file
/// The vertices of a cell with names that its neighbours give them too.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <powercell/results.hpp>
#include <span>
#include <utility>
#include <vector>

#include "lib/base/random.hpp"
#include "lib/domain/period.hpp"
#include "lib/exchange/cut_test.hpp"

namespace powercell::exchange {

/// A number for each seed that a shard knows.
using Handle = std::uint32_t;

/// The region of a vertex, and the seeds, facets and regions whose planes meet in it, in ascending order.
/// Vertices of the same name are the same point, whichever cell they were computed from; in a periodic domain
/// one of its images.
struct VertexName {
  std::array<std::uint64_t, 5> part{};
  friend bool operator==(const VertexName&, const VertexName&) = default;
};

struct VertexHash {
  std::size_t operator()(const VertexName& name) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t part : name.part) hash = mixed_bits(hash ^ part);
    return static_cast<std::size_t>(hash);
  }
};

/// The distance of the farthest vertex of a cell from its seed, at least `least_radius`.
/// \param row  of the cell in `cells`
/// \param seed  its position
double radius_of(const Cells& cells, std::size_t row, const double* seed);

/// The vertices of one cell that are on its boundary. The memory is reused from cell to cell, and names are
/// those of one object.
class CellVertices {
 public:
  /// \param self    the handle of the cell's seed
  /// \param handle  by index of the seeds of `cells`
  void set(const Cells& cells, std::size_t row, const double* seed, Handle self,
           std::span<const Handle> handle);

  std::size_t size() const { return offset_.size(); }
  const Point& offset(std::size_t v) const { return offset_[v]; }  ///< from the seed
  const VertexName& name(std::size_t v) const { return name_[v]; }

 private:
  /// Lists the faces of each vertex of a piece.
  void find_faces(const Cells& cells, std::size_t piece);
  /// Appends the name of a vertex, if it is on the boundary of the cell.
  /// \return whether it is
  bool add_name(const Cells& cells, std::size_t piece, std::size_t vertex, Handle self,
                std::span<const Handle> handle);

  /// Gives seeds of a vertex the numbers of their images, those moved together the same.
  void number_images(std::array<std::uint64_t, 4>& seed, std::array<Shift, 4>& shift, std::size_t count);

  std::vector<Point> offset_;
  std::vector<VertexName> name_;
  std::map<std::pair<std::uint64_t, Shift>, std::uint64_t> images_;  // of seeds that are moved: their numbers
  std::vector<std::array<std::uint64_t, 3>> face_;                   // of each vertex of a piece
  std::vector<std::uint8_t> faces_;                                  // their number
};

}  // namespace powercell::exchange
