/// \file
/// The few operations of GEOS that polygons need, behind its reentrant C interface.
#pragma once

#include <geos_c.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/domain/rings.hpp"

namespace powercell::geos {

class Context;

struct Destroy {
  GEOSContextHandle_t handle = nullptr;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
  void operator()(GEOSSTRtree* tree) const { GEOSSTRtree_destroy_r(handle, tree); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

/// A context of its own for each use, so that domains can be built in several threads.
/// Failures inside GEOS become Error internal with its message, unless said otherwise.
class Context {
 public:
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// One outer ring and its holes.
  Geometry polygon(const IndexedRings& vertices, std::span<const IndexedRing> rings);
  Geometry multipolygon(const std::vector<Geometry>& polygons);
  Geometry segment(const double* a, const double* b);

  // GEOS computes in double: where coordinates span many orders of magnitude it may give up. What may be
  // wrong counts as wrong, and why it is not known is the reason.

  /// If the geometry is not valid: why, and where.
  std::optional<std::string> defect(const Geometry& geometry);
  /// If the interiors of a and b meet: where.
  std::optional<std::string> overlap(const Geometry& a, const Geometry& b);

 private:
  friend class Tree;
  Geometry own(GEOSGeometry* geometry, const char* operation);
  GEOSCoordSequence* sequence(const std::vector<double>& xy);
  [[noreturn]] void fail(const char* operation) const;
  GEOSContextHandle_t handle_;
  std::string message_;
};

/// Bounding boxes with numbers, and which of them meet a box.
class Tree {
 public:
  explicit Tree(Context& context);
  void insert(const Geometry& extent, std::size_t number);
  void query(const Geometry& extent, const std::function<void(std::size_t)>& visit);

 private:
  Context& context_;
  std::unique_ptr<GEOSSTRtree, Destroy> tree_;
};

}  // namespace powercell::geos
