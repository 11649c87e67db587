#include "lib/update/kept_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/base/threads.hpp"
#include "lib/collect/walls.hpp"
#include "lib/integrate/moment_sums.hpp"
#include "lib/update/cells.hpp"
#include "lib/update/repair.hpp"

namespace powercell {
namespace {

constexpr std::size_t shared_cells = 512;  // cells; fewer are faster on one thread
/// The cells fill the domain but for rounding.
constexpr double most_missing = 1e-11;

template <int D>
class KeptMesh final : public KeptDiagram {
 public:
  KeptMesh(const DomainBuffers& domain, const SeedSet& seeds, int threads)
      : domain_(domain),
        threads_(threads_for(seeds.size(), threads, shared_cells)),
        scene_(make_host_scene(domain.mesh(), domain.frame(), sites_of(seeds))),
        bounds_(scene_) {
    std::array<double, 3> low{}, high{};
    for (std::size_t k = 0; k < D; ++k) {
      low[k] = high[k] = scene_.corners[0][k];
      for (const auto& corner : scene_.corners) {
        low[k] = std::min(low[k], corner[k]);
        high[k] = std::max(high[k], corner[k]);
      }
    }
    frame_ = FarFrame<D>::around(scene_.points, low, high);
    mesh_.build(scene_.points, frame_.points);
    mesh_.sort_simplices();
    find_broken(mesh_, false, threads_, centers_);
    const auto share = [&](std::size_t t) {
      return static_cast<std::uint32_t>(seeds.size() * t / static_cast<std::size_t>(threads_));
    };
    for (std::size_t t = 0; t < static_cast<std::size_t>(threads_); ++t)
      evaluators_.emplace_back(mesh_, centers_, bounds_, scene_, share(t), share(t + 1));
  }

  void update(const SeedSet& seeds, bool moved) override {
    scene_.points = sites_of(seeds);
    if (!frame_.holds(scene_.points)) throw MeshUnusable();
    std::copy(scene_.points.begin(), scene_.points.end(), mesh_.sites().begin());
    repair(mesh_, find_broken(mesh_, moved, threads_, centers_), moved, centers_);
  }

  Results evaluate(const SeedSet& seeds, double domain_measure, bool adjacency) override {
    MomentSums sums(domain_, seeds, domain_measure, threads_);
    WallCollector walls(adjacency ? seeds.size() : 0, threads_);
    std::vector<std::uint64_t> clipped(evaluators_.size());
    parallel_for(threads_, evaluators_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t) {
        const std::size_t begin = seeds.size() * t / evaluators_.size(),
                          end = seeds.size() * (t + 1) / evaluators_.size();
        CellEvaluator<D>& cell = evaluators_[t];
        for (auto rank = static_cast<std::uint32_t>(begin); rank < end; ++rank) {
          const bool has_points = cell.evaluate(rank);
          if (cell.was_clipped()) ++clipped[t];
          if (!has_points) continue;
          sums.set(rank, cell.moments());
          if (adjacency) walls.set_row(rank, cell.neighbors(), cell.walls(), t);
        }
      }
    });
    mesh_.clear_changes();
    Results results{sums.finish(), {}, 0};
    for (const std::uint64_t count : clipped) results.clipped += count;
    if (!(results.measures.relative_error() < most_missing)) throw MeshUnusable();
    if (adjacency)
      results.adjacency = walls.finish(seeds, results.measures.status, domain_.frame().unit(D - 1), 0);
    return results;
  }

 private:
  std::vector<Site> sites_of(const SeedSet& seeds) const {
    const double scale = domain_.frame().scale;
    std::vector<Site> sites(seeds.size());
    parallel_for(threads_for(seeds.size(), threads_), seeds.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t rank = begin; rank < end; ++rank) {
        for (std::size_t k = 0; k < D; ++k) sites[rank][k] = scale * seeds.positions[D * rank + k];
        sites[rank][3] = domain_.frame().weight_to_device(seeds.weights[rank]);
      }
    });
    return sites;
  }

  const DomainBuffers& domain_;
  const int threads_;
  HostScene scene_;
  ConvexBounds bounds_;
  FarFrame<D> frame_;
  DualMesh<D> mesh_;
  std::vector<Center> centers_;
  std::vector<CellEvaluator<D>> evaluators_;
};

}  // namespace

bool KeptDiagram::is_possible(const DomainBuffers& domain) {
  const RegionMesh& mesh = domain.mesh();
  return mesh.region_count() == 1 && !mesh.period && mesh.dimension == mesh.cell_dimension &&
         !domain.float32();
}

std::unique_ptr<KeptDiagram> KeptDiagram::make(const DomainBuffers& domain, const SeedSet& seeds,
                                               int threads) {
  if (domain.mesh().dimension == 2) return std::make_unique<KeptMesh<2>>(domain, seeds, threads);
  return std::make_unique<KeptMesh<3>>(domain, seeds, threads);
}

}  // namespace powercell
