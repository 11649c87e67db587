#include <algorithm>
#include <atomic>

#include "bench/box_cell.hpp"
#include "bench/cgal_3d.hpp"
#include "bench/peers.hpp"

namespace powercell::bench {

namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

template <class Cgal>
class BoxCells {
 public:
  BoxCells(Cgal& cgal, const SeedsView& seeds, const Box& box)
      : t_(*cgal.triangulation), seeds_(seeds), box_(box), measures_(seeds.size(), 0.0) {
    for (auto c = t_.all_cells_begin(); c != t_.all_cells_end(); ++c) cells_.push_back(c);
  }

  std::vector<double> measure() {
    place_dual_points();
    for_each_(cells_.size(), [&](std::size_t k) { add_facets(cells_[k]); });
    clip_cut_cells();
    return std::move(measures_);
  }

 private:
  /// Computes the dual point of each finite cell and marks the seeds whose power cells reach the faces of the
  /// box.
  void place_dual_points() {
    for_each_(cells_.size(), [&](std::size_t k) {
      if (t_.is_infinite(cells_[k])) return;
      const auto x = t_.dual(cells_[k]);
      cells_[k]->info() = {x, x.x() > box_.low[0] && x.x() < box_.high[0] && x.y() > box_.low[1] &&
                                  x.y() < box_.high[1] && x.z() > box_.low[2] && x.z() < box_.high[2]};
    });
    cut_.assign(seeds_.size(), 0);
    for (const auto c : cells_) {
      if (c->info().inside) continue;
      for (int k = 0; k < 4; ++k)
        if (!t_.is_infinite(c->vertex(k))) cut_[c->vertex(k)->info()] = 1;
    }
  }

  /// The dual of a facet is an edge of three walls. For each of them adds the tetrahedra of this edge, the
  /// foot of the wall and the seeds on both sides; signed, since a seed may lie outside its cell.
  void add_facets(typename Cgal::Cell_handle c) {
    for (int k = 0; k < 4; ++k) {
      const auto other = c->neighbor(k);
      // Each facet once. If a dual point is not inside, all seeds of its cell are cut: nothing to add.
      if (!(c < other) || !c->info().inside || !other->info().inside) continue;
      const auto x = c->info().point;
      const auto edge = x - other->info().point;  // so that walls are oriented along q
      for (int e = 0; e < 3; ++e) {
        const auto a = c->vertex(t_.vertex_triple_index(k, e)),
                   b = c->vertex(t_.vertex_triple_index(k, (e + 1) % 3));
        const std::uint32_t i = a->info(), j = b->info();
        if (cut_[i] && cut_[j]) continue;
        const auto q = b->point().point() - a->point().point();
        const double q2 = q.squared_length();
        const double s = (q2 + a->point().weight() - b->point().weight()) / (2 * q2);
        // |foot - p_i|, |foot - p_j| are s and 1 - s times |q|, both along q.
        const double wall = q * CGAL::cross_product(x - (a->point().point() + s * q), edge) / 6;
        if (!cut_[i]) add(i, s * wall);
        if (!cut_[j]) add(j, (1 - s) * wall);
      }
    }
  }

  void add(std::size_t i, double part) {
    if constexpr (Cgal::parallel)
      std::atomic_ref(measures_[i]).fetch_add(part, std::memory_order_relaxed);
    else
      measures_[i] += part;
  }

  void clip_cut_cells() {
    std::vector<Pair> pairs;
    for (const auto c : cells_)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b)
          if (a != b && !t_.is_infinite(c->vertex(a)) && !t_.is_infinite(c->vertex(b)) &&
              cut_[c->vertex(a)->info()])
            pairs.emplace_back(c->vertex(a)->info(), c->vertex(b)->info());
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<std::size_t> first;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (k == 0 || pairs[k].first != pairs[k - 1].first) first.push_back(k);
    for_each_(first.size(), [&](std::size_t c) {
      const std::uint32_t i = pairs[first[c]].first;
      std::vector<std::uint32_t> neighbors;
      for (std::size_t k = first[c]; k < pairs.size() && pairs[k].first == i; ++k)
        neighbors.push_back(pairs[k].second);
      measures_[i] = cell_volume_in_box(seeds_, i, neighbors, box_);
    });
  }

  const typename Cgal::Triangulation& t_;
  const SeedsView& seeds_;
  const Box& box_;
  typename Cgal::Loop for_each_;
  std::vector<typename Cgal::Cell_handle> cells_;
  std::vector<char> cut_;
  std::vector<double> measures_;
};

template <class Tag>
std::vector<double> measures_3d(const SeedsView& seeds, const Box& box) {
  Cgal3d<Tag> cgal(seeds);
  return BoxCells<Cgal3d<Tag>>(cgal, seeds, box).measure();
}

}  // namespace

std::vector<double> cgal_measures_3d(const SeedsView& seeds, const Box& box) {
  return measures_3d<CGAL::Sequential_tag>(seeds, box);
}

std::vector<double> cgal_parallel_measures_3d(const SeedsView& seeds, const Box& box) {
  return measures_3d<CGAL::Parallel_tag>(seeds, box);
}

}  // namespace powercell::bench
