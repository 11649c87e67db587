#include <algorithm>
#include <array>
#include <atomic>
#include <thread>

#include "bench/cgal_3d.hpp"
#include "bench/peers.hpp"
#include "bench/restricted.hpp"

namespace powercell::bench {

namespace {

constexpr std::uint32_t infinite = ~std::uint32_t{0};  // the vertex at infinity

/// The bisectors of each seed with its finite neighbours in the triangulation, nearest first.
template <class Cgal>
Links links_of(const Cgal& cgal, const SeedsView& seeds) {
  const auto& t = *cgal.triangulation;
  const std::size_t n = seeds.size();
  const typename Cgal::Loop for_each;
  std::vector<typename Cgal::Cell_handle> cells;
  for (auto c = t.all_cells_begin(); c != t.all_cells_end(); ++c) cells.push_back(c);

  // Every cell adds to the row of each of its vertices the other three. Repeated neighbours are removed per
  // row.
  std::vector<std::array<std::uint32_t, 4>> corners(cells.size());
  std::vector<std::uint32_t> end(n + 1, 0);
  for_each(cells.size(), [&](std::size_t k) {
    for (int v = 0; v < 4; ++v) {
      const auto vertex = cells[k]->vertex(v);
      const std::uint32_t i = corners[k][static_cast<std::size_t>(v)] =
          t.is_infinite(vertex) ? infinite : vertex->info();
      if (i != infinite) std::atomic_ref(end[i + 1]).fetch_add(3, std::memory_order_relaxed);
    }
  });
  for (std::size_t i = 0; i < n; ++i) end[i + 1] += end[i];
  std::vector<std::uint32_t> gathered(end[n]), cursor(end.begin(), end.end() - 1);
  for_each(cells.size(), [&](std::size_t k) {
    for (const std::uint32_t i : corners[k]) {
      if (i == infinite) continue;
      std::uint32_t at = std::atomic_ref(cursor[i]).fetch_add(3, std::memory_order_relaxed);
      for (const std::uint32_t j : corners[k])
        if (j != i) gathered[at++] = j;
    }
  });

  Links links;
  links.offset.assign(n + 1, 0);
  for_each(n, [&](std::size_t i) {
    const auto row = gathered.begin() + end[i], last = gathered.begin() + end[i + 1];
    std::sort(row, last);  // the vertex at infinity is last
    links.offset[i + 1] =
        static_cast<std::size_t>(std::lower_bound(row, std::unique(row, last), infinite) - row);
  });
  for (std::size_t i = 0; i < n; ++i) links.offset[i + 1] += links.offset[i];
  links.list.resize(links.offset[n]);
  for_each(n, [&](std::size_t i) {
    const auto row = links.list.begin() + static_cast<std::ptrdiff_t>(links.offset[i]),
               last = links.list.begin() + static_cast<std::ptrdiff_t>(links.offset[i + 1]);
    std::transform(gathered.begin() + end[i], gathered.begin() + end[i] + (last - row), row,
                   [&](std::uint32_t j) { return make_link(seeds, static_cast<std::uint32_t>(i), j); });
    std::sort(row, last, [](const Link& a, const Link& b) { return a.distance < b.distance; });
  });
  return links;
}

template <class Tag>
std::vector<double> measures_on(const SeedsView& seeds, const test::Mesh& mesh, int corners) {
  using Cgal = Cgal3d<Tag>;
  const Cgal cgal(seeds);
  const Links links = links_of(cgal, seeds);
  return restricted_measures(mesh, corners, seeds, links,
                             Cgal::parallel ? std::thread::hardware_concurrency() : 1);
}

}  // namespace

std::vector<double> cgal_measures_on(const SeedsView& seeds, const test::Mesh& mesh, int corners) {
  return measures_on<CGAL::Sequential_tag>(seeds, mesh, corners);
}

std::vector<double> cgal_parallel_measures_on(const SeedsView& seeds, const test::Mesh& mesh, int corners) {
  return measures_on<CGAL::Parallel_tag>(seeds, mesh, corners);
}

}  // namespace powercell::bench
