#include <limits>
#include <powercell/error.hpp>

#include "lib/applications/remeshing/cell_loop.hpp"
#include "lib/applications/remeshing/dual.hpp"
#include "lib/applications/remeshing/mesh_check.hpp"

namespace powercell::remeshing {
namespace {

/// The longest chord at a seed, as a curve and a rank.
/// \return false if the seed is not on a curve
bool longest_chord(const Sampling& sampling, std::uint32_t seed,
                   std::pair<std::uint32_t, std::size_t>& chord) {
  double longest = 0;
  for (std::uint32_t c = 0; c < sampling.curve_count(); ++c) {
    const auto& seeds = sampling.on_curve(c);
    for (std::size_t k = 0; k + 1 < seeds.size(); ++k) {
      if (seeds[k] != seed && seeds[k + 1] != seed) continue;
      const LocalDiagram& diagram = sampling.diagram();
      const double length = norm(diagram.seed(seeds[k]).at - diagram.seed(seeds[k + 1]).at);
      if (length <= longest) continue;
      longest = length;
      chord = {c, k};
    }
  }
  return longest > 0;
}

/// Adds a seed in a cell, on a chord of its seed or in a neighbouring cell.
void add_in_cell(Sampling& sampling, std::uint32_t seed) {
  const FarPoint far = sampling.farthest_of(seed);
  if (far.place.triangle != nothing) {
    sampling.add_between(far.place);
    return;
  }
  std::pair<std::uint32_t, std::size_t> chord;
  if (longest_chord(sampling, seed, chord) && sampling.can_split(chord.first, chord.second)) {
    sampling.split(chord.first, chord.second);
    return;
  }
  for (const std::uint32_t j : sampling.diagram().neighbors(seed))
    if (const FarPoint other = sampling.farthest_of(j); other.place.triangle != nothing) {
      sampling.add_between(other.place);
      return;
    }
}

/// Adds seeds on loops around what a cell that is not a disc, or two cells that share several walls,
/// surround. At a tip, seeds at farthest vertices would only converge to it.
void add_around(Sampling& sampling, const Defects& defects, Progress& progress) {
  const LocalDiagram& diagram = sampling.diagram();
  for (const std::uint32_t i : defects.not_discs)
    for (const Place& place : points_around(diagram, i, sampling.hold(i).place)) {
      progress.tick();
      sampling.add_between(place);
    }
  if (!defects.not_discs.empty()) return;
  for (const auto& [a, b] : defects.twice) {
    progress.tick();
    const Place place = point_between(diagram, a, b, sampling.hold(a).place);
    if (place.triangle != nothing) sampling.add_between(place);
  }
}

/// Adds one seed for a defect that several cells share. Remaining defects are found in the next round.
void add_in_cells(Sampling& sampling, const std::vector<std::uint32_t>& seeds, Progress& progress) {
  std::vector<char> treated(sampling.diagram().size(), 0);
  for (const std::uint32_t i : seeds) {
    if (treated[i]) continue;
    progress.tick();
    treated[i] = 1;
    for (const std::uint32_t j : sampling.diagram().neighbors(i))
      if (j < treated.size()) treated[j] = 1;
    add_in_cell(sampling, i);
  }
}

/// Treats the defects of the first kind present, as those of later kinds may vanish with them.
/// \return whether anything changed
bool treat(Sampling& sampling, const Defects& defects, Progress progress) {
  const std::size_t before = sampling.diagram().alive();
  bool changed = false;
  for (const std::uint32_t i : defects.outside) {
    progress.tick();
    changed |= sampling.give_cell(i);
  }
  if (changed) return true;
  // Later ranks of a curve first, so that earlier ones stay valid.
  // NOLINTNEXTLINE(modernize-loop-convert): clang 14 does not compile the reversed view of libstdc++ 12.
  for (auto chord = defects.chords.rbegin(); chord != defects.chords.rend(); ++chord)
    if (sampling.can_split(chord->first, chord->second)) sampling.split(chord->first, chord->second);
  for (const Place& fragment : defects.fragments) {
    progress.tick();
    sampling.add_between(fragment);
  }
  if (sampling.diagram().alive() == before) add_around(sampling, defects, progress);
  if (sampling.diagram().alive() == before) add_in_cells(sampling, defects.seeds, progress);
  return sampling.diagram().alive() > before;
}

/// A place of a defect.
Place place_of(const Sampling& sampling, const Defects& defects) {
  if (!defects.fragments.empty()) return defects.fragments.front();
  for (const auto* seeds : {&defects.outside, &defects.not_discs, &defects.seeds})
    if (!seeds->empty()) return sampling.hold(seeds->front()).place;
  if (!defects.twice.empty()) return sampling.hold(defects.twice.front().first).place;
  const auto [curve, rank] = defects.chords.front();
  return sampling.hold(sampling.on_curve(curve)[rank]).place;
}

}  // namespace

std::optional<DualMesh> mend(Sampling& sampling, std::size_t most, Place& left, Progress progress) {
  constexpr int patience = 12;  // rounds without fewer defects than ever before
  const Surface& surface = sampling.diagram().surface();
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (int without_gain = 0; without_gain < patience; ++without_gain) {
    progress.at(0);
    Defects defects;
    DualMesh dual = dual_of(sampling, defects, progress);
    progress.at(0);
    if (defects.count() == 0) {
      const MeshCheck check = check_mesh(dual.triangle, sampling.diagram().size());
      if (check.euler != surface.euler_characteristic() || check.loops != boundary_loops(surface))
        throw Error(ErrorCode::internal, "the dual is a manifold, but not of the topology of the surface");
      return dual;
    }
    left = place_of(sampling, defects);
    if (defects.count() < least) {
      least = defects.count();
      without_gain = 0;
    }
    if (!treat(sampling, defects, progress) || sampling.diagram().alive() > most) break;
  }
  return std::nullopt;
}

}  // namespace powercell::remeshing
