/// \file
/// A domain as convex regions, the form that the enumeration of pairs and the kernels read, and what is
/// computed from it alone.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <powercell/regions.hpp>
#include <typeindex>
#include <typeinfo>
#include <vector>

#include "lib/domain/period.hpp"

namespace powercell {

/// Values, one of a type, made on first use. Thread-safe: who asks for a value while it is made waits. They
/// live as long as their owner, or longer where they are held. A copy of the owner starts without values.
class KeptValues {
 public:
  KeptValues() = default;
  KeptValues(const KeptValues&) {}
  KeptValues& operator=(const KeptValues&) {
    values_.clear();
    return *this;
  }
  ~KeptValues() = default;

  /// \param make  returns a shared pointer to the value; may ask for other values, but not for this one
  /// \throw what `make` throws; the next call makes the value again
  template <class T, class Make>
  std::shared_ptr<const T> get(const Make& make) const {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const void>& value = values_[std::type_index(typeid(T))];
    if (!value) value = std::shared_ptr<const T>(make());
    return std::static_pointer_cast<const T>(value);
  }

 private:
  mutable std::recursive_mutex mutex_;
  mutable std::map<std::type_index, std::shared_ptr<const void>> values_;
};

/// The corners of facet k of a positive tetrahedron, opposite corner k, counter-clockwise seen from outside.
inline constexpr std::uint32_t tetrahedron_facet[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

struct RegionMesh {
  DomainKind kind = DomainKind::polygon;
  int dimension = 0;       ///< coordinates of a vertex
  int cell_dimension = 0;  ///< 2 or 3
  RegionShape shape = RegionShape::polygon;
  std::vector<double> vertices;              ///< nv x dimension
  std::vector<std::uint32_t> region_offset;  ///< regions + 1, into region_vertex
  std::vector<std::uint32_t> region_vertex;
  /// Facet slots of each region. Polygon: edge k goes from vertex k to k+1, so slots are parallel to
  /// region_vertex. Tetrahedron: facet k is opposite vertex k. Box: -x +x -y +y -z +z.
  /// `boundary` facets are numbered 0 .. boundary_count-1; `interior` ones have the index of the region
  /// behind. Edges between convex pieces of a polygon and edges shared by triangles are interior.
  std::vector<Border> facet;
  std::vector<std::uint32_t> facet_offset;  ///< regions + 1, into facet
  std::vector<std::uint32_t> source;        ///< per region: index of the input part, triangle or tetrahedron
  std::uint32_t boundary_count = 0;
  double measure = 0;
  std::array<double, 3> low{}, high{};  ///< bounding box of the regions
  MeshReport report;
  std::shared_ptr<const Period> period;  ///< of a periodic domain, which is one region; else null
  /// Of a solid, which has no regions: its boundary as outward triangles (boundary_surface). Else null.
  std::shared_ptr<const RegionMesh> solid_boundary;
  KeptValues kept;  ///< what diagrams need of the mesh, once it does not change any more

  std::size_t region_count() const { return source.size(); }
};

}  // namespace powercell
