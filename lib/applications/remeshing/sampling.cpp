#include "lib/applications/remeshing/sampling.hpp"

#include <algorithm>
#include <map>
#include <powercell/error.hpp>
#include <string>

#include "lib/base/random.hpp"

namespace powercell::remeshing {
namespace {

// Relative random change of weights, which brings the seeds into general position.
constexpr double jitter = 1e-7;
// Least squared distance of seeds, as a share of their weight: rounding moves a bisector by some 1e-16 of it.
constexpr double least_share = 1e-13;

}  // namespace

Sampling::Sampling(const Surface& surface, const Sizing& sizing, std::vector<Curve> curves,
                   std::uint64_t random_seed)
    : surface_(surface),
      sizing_(sizing),
      curves_(std::move(curves)),
      diagram_(surface),
      on_curve_(curves_.size()),
      corner_of_vertex_(surface.vertex.size(), nothing),
      random_(random_seed) {}

std::uint32_t Sampling::add(const Hold& hold) {
  const double h = sizing_at(hold.place);
  return add(hold, weight_share * h * h * (1 + jitter * uniform(random_)), h);
}

std::uint32_t Sampling::add(const Hold& hold, double weight, double h) {
  const std::uint32_t id = diagram_.insert(hold.place.at, weight, h);
  if (id >= hold_.size()) {
    hold_.resize(id + 1);
    chord_.resize(id + 1);
    far_.resize(id + 1);
  }
  hold_[id] = hold;
  measure_changed();
  return id;
}

std::uint32_t Sampling::add_between(const Hold& hold) {
  const std::uint32_t in = owner(hold.place);
  if (in == nothing) return add(hold);  // because of rounding no seed has the triangle
  const Seed of = diagram_.seed(in);
  // The jitter is relative to the distance, which may be small compared with the weight.
  const double distance2 = std::max(norm2(of.at - hold.place.at), least_share * of.weight);
  return add(hold, of.weight + jitter * uniform(random_) * distance2, of.size);
}

std::uint32_t Sampling::add_between(const Place& place) {
  const std::uint32_t in = owner(place);
  if (in != nothing && norm2(diagram_.seed(in).at - place.at) <= least_share * diagram_.seed(in).weight)
    return nothing;
  return add_between({Hold::Kind::free, nothing, 0, place});
}

bool Sampling::give_cell(std::uint32_t seed) {
  const Hold hold = hold_[seed];
  remove(seed);
  add_between(hold);  // gets the index just freed
  return owner(hold.place) == seed;
}

void Sampling::remove(std::uint32_t seed) {
  diagram_.remove(seed);
  measure_changed();
}

void Sampling::measure_changed() {
  for (const std::uint32_t i : diagram_.changed()) {
    far_[i] = diagram_.seed(i).alive ? farthest_of(i) : FarPoint{};
    heap_.set(i, far_[i].priority);
  }
}

/// Whether x is in the ball whose diameter is a chord from a seed to its neighbour on a curve. A seed there
/// would separate their cells.
bool Sampling::in_curve_ball(std::uint32_t seed, Vec x) const {
  const Vec to = diagram_.seed(seed).at - x;
  return std::any_of(chord_[seed].begin(), chord_[seed].end(),
                     [&](std::uint32_t other) { return dot(to, diagram_.seed(other).at - x) < 0; });
}

FarPoint Sampling::farthest_of(std::uint32_t seed) const {
  FarPoint far;
  const double h = diagram_.seed(seed).size, scale = 1 / (h * h);
  for (const std::uint32_t p : diagram_.pieces(seed)) {
    const Piece& piece = diagram_.piece(p);
    for (std::size_t v = 0; v < piece.ring.size(); ++v) {
      const Corner& corner = piece.ring[v];
      const double priority = diagram_.power(seed, corner.at) * scale;
      if (priority <= far.priority) continue;
      const Corner& before = piece.ring[v == 0 ? piece.ring.size() - 1 : v - 1];
      // Points on kept edges are left to the seeds of the curve.
      const auto on_kept = [&](const Corner& c) {
        return c.edge < 0 && surface_.kept[piece.triangle][static_cast<std::size_t>(~c.edge)];
      };
      if (on_kept(corner) || on_kept(before)) continue;
      const auto near_curve = [&](const Corner& c) {
        return c.edge >= 0 && in_curve_ball(static_cast<std::uint32_t>(c.edge), corner.at);
      };
      if (in_curve_ball(seed, corner.at) || near_curve(corner) || near_curve(before)) continue;
      far = {{piece.triangle, corner.at}, priority};
    }
  }
  return far;
}

FarPoint Sampling::farthest() const {
  return heap_.top() > MaxTree::lowest ? far_[heap_.top_index()] : FarPoint{};
}

std::uint32_t Sampling::corner_seed(std::uint32_t vertex, const Place& place) {
  std::uint32_t& seed = corner_of_vertex_[vertex];
  if (seed == nothing)
    seed = add({Hold::Kind::corner, nothing, 0, {place.triangle, surface_.vertex[vertex]}});
  return seed;
}

void Sampling::place_on_curves(std::size_t most) {
  // Several curves between the same two corners need an inner seed each, else they would share one edge.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> same_ends;
  const auto ends = [&](const Curve& c) { return std::minmax(c.vertex.front(), c.vertex.back()); };
  for (const Curve& c : curves_)
    if (!c.closed) ++same_ends[ends(c)];
  std::vector<std::vector<double>> along;
  std::size_t count = 0;
  for (const Curve& c : curves_) {
    const bool loop = !c.closed && c.vertex.front() == c.vertex.back();
    const std::size_t least = loop ? 3 : !c.closed && same_ends[ends(c)] > 1 ? 2 : 1;
    along.push_back(seeds_along(sizing_, c, least));
    count += along.back().size() - (c.closed ? 0 : 2);
  }
  std::vector<std::uint32_t> corners;
  for (const Curve& c : curves_)
    if (!c.closed) corners.insert(corners.end(), {c.vertex.front(), c.vertex.back()});
  std::sort(corners.begin(), corners.end());
  count += static_cast<std::size_t>(std::unique(corners.begin(), corners.end()) - corners.begin());
  if (count > most)
    throw Error(ErrorCode::invalid_argument,
                "too few points: corners, boundaries and sharp edges alone need " + std::to_string(count) +
                    "; ask for several times as many, since edges then become shorter there too, or keep "
                    "fewer edges by a larger sharp angle");
  // In random order: along curves, the cells of the last seeds would extend over the rest of the surface.
  std::vector<std::pair<std::uint32_t, std::size_t>> order;
  for (std::uint32_t c = 0; c < curves_.size(); ++c) {
    on_curve_[c].resize(along[c].size());
    for (std::size_t k = 0; k < along[c].size(); ++k) order.emplace_back(c, k);
  }
  for (std::size_t k = order.size(); k > 1; --k) {
    const auto other = static_cast<std::size_t>(uniform(random_) * static_cast<double>(k));
    std::swap(order[k - 1], order[other]);
  }
  for (const auto& [c, k] : order) {
    const Curve& curve = curves_[c];
    const bool end = !curve.closed && (k == 0 || k + 1 == along[c].size());
    const Place place = curve.at(surface_, along[c][k]);
    on_curve_[c][k] = end ? corner_seed(k == 0 ? curve.vertex.front() : curve.vertex.back(), place)
                          : add({Hold::Kind::curve, c, along[c][k], place});
  }
  link_curves();
}

/// Records the chords of the curves.
void Sampling::link_curves() {
  for (std::uint32_t c = 0; c < curves_.size(); ++c) {
    std::vector<std::uint32_t>& seeds = on_curve_[c];
    if (curves_[c].closed) seeds.push_back(seeds.front());
    for (std::size_t k = 0; k + 1 < seeds.size(); ++k) {
      chord_[seeds[k]].push_back(seeds[k + 1]);
      chord_[seeds[k + 1]].push_back(seeds[k]);
    }
  }
  // The farthest vertices depend on the chords.
  for (std::uint32_t i = 0; i < diagram_.size(); ++i) {
    far_[i] = farthest_of(i);
    heap_.set(i, far_[i].priority);
  }
}

bool Sampling::can_split(std::uint32_t c, std::size_t rank) const {
  const Seed &a = diagram_.seed(on_curve_[c][rank]), &b = diagram_.seed(on_curve_[c][rank + 1]);
  return norm2(a.at - b.at) > 4 * least_share * std::max(a.weight, b.weight);
}

std::uint32_t Sampling::split(std::uint32_t c, std::size_t rank) {
  std::vector<std::uint32_t>& seeds = on_curve_[c];
  const std::uint32_t a = seeds[rank], b = seeds[rank + 1];
  const auto along = [&](std::uint32_t seed, bool end) {
    if (hold_[seed].kind == Hold::Kind::curve && !(end && rank + 2 == seeds.size() && curves_[c].closed))
      return hold_[seed].along;
    return end ? curves_[c].length() : 0.0;
  };
  const double s = (along(a, false) + along(b, true)) / 2;
  const std::uint32_t id = add_between({Hold::Kind::curve, c, s, curves_[c].at(surface_, s)});
  seeds.insert(seeds.begin() + static_cast<std::ptrdiff_t>(rank) + 1, id);
  std::replace(chord_[a].begin(), chord_[a].end(), b, id);
  std::replace(chord_[b].begin(), chord_[b].end(), a, id);
  chord_[id] = {a, b};
  for (const std::uint32_t i : {a, b, id}) {
    far_[i] = farthest_of(i);
    heap_.set(i, far_[i].priority);
  }
  return id;
}

std::vector<std::uint32_t> Sampling::free_seeds() const {
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t i = 0; i < diagram_.size(); ++i)
    if (diagram_.seed(i).alive && hold_[i].kind == Hold::Kind::free) seeds.push_back(i);
  return seeds;
}

std::uint32_t Sampling::owner(const Place& place) const {
  std::uint32_t best = nothing;
  for (const std::uint32_t p : diagram_.pieces_in(place.triangle)) {
    const std::uint32_t i = diagram_.piece(p).seed;
    if (best == nothing || diagram_.power(i, place.at) < diagram_.power(best, place.at)) best = i;
  }
  return best;
}

double Sampling::least_spacing() const {
  double least = 1e300;
  for (std::uint32_t i = 0; i < diagram_.size(); ++i) {
    if (!diagram_.seed(i).alive) continue;
    for (const std::uint32_t j : diagram_.neighbors(i)) {
      const double h = (diagram_.seed(i).size + diagram_.seed(j).size) / 2;
      least = std::min(least, norm(diagram_.seed(i).at - diagram_.seed(j).at) / h);
    }
  }
  return least;
}

}  // namespace powercell::remeshing
