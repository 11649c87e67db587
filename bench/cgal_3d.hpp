/// \file
/// CGAL's regular triangulation of seeds in space, on one thread or with CGAL's parallel insertion.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "bench/loops.hpp"
#include "powercell/seeds.hpp"

namespace powercell::bench {

/// \tparam ConcurrencyTag CGAL::Sequential_tag or CGAL::Parallel_tag
template <class ConcurrencyTag>
struct Cgal3d {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;
  /// The dual point of a cell and whether it lies inside the domain's box.
  struct Dual {
    Point point;
    bool inside = false;
  };
  using Vertex =
      CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel,
                                                  CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
  using Cell = CGAL::Triangulation_cell_base_with_info_3<Dual, Kernel,
                                                         CGAL::Regular_triangulation_cell_base_3<Kernel>>;
  using Triangulation =
      CGAL::Regular_triangulation_3<Kernel,
                                    CGAL::Triangulation_data_structure_3<Vertex, Cell, ConcurrencyTag>>;
  using Cell_handle = typename Triangulation::Cell_handle;
  using Vertex_handle = typename Triangulation::Vertex_handle;
  static constexpr bool parallel = std::is_convertible_v<ConcurrencyTag, CGAL::Parallel_tag>;
  using Loop = std::conditional_t<parallel, ParallelLoop, SerialLoop>;

  /// Inserts all seeds at once; a vertex's info is the index of its seed.
  explicit Cgal3d(const SeedsView& seeds) {
    std::vector<std::pair<typename Triangulation::Weighted_point, std::uint32_t>> points;
    points.reserve(seeds.size());
    CGAL::Bbox_3 bounds;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const double* p = &seeds.positions[3 * i];
      const Point point(p[0], p[1], p[2]);
      bounds += point.bbox();
      points.emplace_back(typename Triangulation::Weighted_point(point, seeds.weights[i]),
                          static_cast<std::uint32_t>(i));
    }
    if constexpr (parallel) {
      constexpr int locks_per_axis = 50;
      locks = std::make_unique<typename Triangulation::Lock_data_structure>(bounds, locks_per_axis);
      triangulation = std::make_unique<Triangulation>(points.begin(), points.end(), locks.get());
    } else {
      triangulation = std::make_unique<Triangulation>(points.begin(), points.end());
    }
  }

  struct NoLocks {};
  std::unique_ptr<std::conditional_t<parallel, typename Triangulation::Lock_data_structure, NoLocks>> locks;
  std::unique_ptr<Triangulation> triangulation;
};

}  // namespace powercell::bench
