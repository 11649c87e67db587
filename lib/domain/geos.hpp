/// \file
/// The few operations of GEOS that polygons need, by its reentrant C interface. Internal.
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

/// A GEOS context. Each domain is built with its own, so several threads can build domains.
/// A failure inside GEOS throws Error internal with its message, except where stated otherwise.
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

  // GEOS computes in double and may give up if coordinates span many orders of magnitude. A geometry that it
  // cannot check counts as invalid; the reason is then its message.

  /// Why and where the geometry is not valid; nothing if it is.
  std::optional<std::string> defect(const Geometry& geometry);
  /// Where the interiors of a and b intersect; nothing if they do not.
  std::optional<std::string> overlap(const Geometry& a, const Geometry& b);

 private:
  friend class Tree;
  Geometry own(GEOSGeometry* geometry, const char* operation);
  GEOSCoordSequence* sequence(const std::vector<double>& xy);
  [[noreturn]] void fail(const char* operation) const;
  GEOSContextHandle_t handle_;
  std::string message_;
};

/// Numbered bounding boxes; finds those that intersect a box.
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
