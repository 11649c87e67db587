#include "lib/exchange/shard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <unordered_set>

#include "lib/base/memory.hpp"
#include "lib/base/positions.hpp"

namespace powercell::exchange {
namespace {

constexpr std::size_t shared_leaves = 1024;  // of eight cells; with fewer, threads cost more than they save
constexpr std::size_t far_vertices = 6;      // that are asked about at a time
/// Seeds of a shard in the plane and in space.
constexpr std::array<std::size_t, 2> least_with_far_cells = {1000, 2000};

}  // namespace

Shard::Shard(int number, std::span<const std::uint64_t> ids, const SeedsView& seeds, int dimension,
             int threads, const Period* period, bool walls)
    : threads_(thread_count(threads)),
      lists_walls_(walls),
      width_(static_cast<std::size_t>(dimension) + 1),
      own_(ids, seeds, dimension, threads, period),
      others_(number),
      moves_(translations(period)),
      open_(own_.size()),
      rows_(own_.size()) {
  std::iota(open_.begin(), open_.end(), Handle{0});
  std::erase_if(open_, [this](Handle cell) { return own_.is_hidden(cell); });
  measures_.dimension = dimension;
  measures_.mass.resize(own_.size());
  measures_.centroid.resize(own_.size() * (width_ - 1), std::numeric_limits<double>::quiet_NaN());
  measures_.second_moment.resize(own_.size());
  measures_.status.resize(own_.size(), SeedStatus::hidden);
  for (const std::uint32_t i : own_.duplicates()) measures_.status[i] = SeedStatus::duplicate;
}

void Shard::set_hidden_aside(const DiagramSetup& setup) {
  own_.set_hidden_aside(setup);
  std::erase_if(open_, [this](Handle cell) { return own_.is_hidden(cell); });
}

void Shard::meet(std::shared_ptr<const FirstCoarseTrees> first) {
  others_.meet(std::move(first));
  near_parts_ = near_shards(own_.in_tree(), others_, moves_);
}

std::vector<Handle> Shard::at_hand(bool all) const {
  std::vector<Handle> handles;
  const auto count = static_cast<Handle>(own_.size() + foreign_id_.size());
  if (all) {
    for (Handle h = 0; h < count; ++h)
      if (!is_gone(h)) handles.push_back(h);
  } else {
    std::vector<bool> needed(count);
    for (const Handle cell : open_) {
      needed[cell] = true;
      for (const Handle neighbor : neighbors_of(cell)) needed[neighbor] = true;
    }
    for (Handle h = 0; h < count; ++h)
      if (needed[h] || h >= own_.size() + foreign_clipped_) handles.push_back(h);
  }
  // The lower id wins between duplicates, as the lower index does in a diagram. Own ids ascend already.
  const auto foreign = std::lower_bound(handles.begin(), handles.end(), static_cast<Handle>(own_.size()));
  const auto by_id = [this](Handle a, Handle b) { return id_of(a) < id_of(b); };
  std::sort(foreign, handles.end(), by_id);
  std::inplace_merge(handles.begin(), foreign, handles.end(), by_id);
  return handles;
}

std::map<int, Request> Shard::clip(Diagram::State& diagram) {
  std::map<int, Request> requests;
  if (open_.empty()) return requests;
  // Where the domain is convex, a proved cell is determined by its walls and the seeds that came since.
  const std::vector<Handle> handles = at_hand(all_needed_ || diagram.setup.domain.region_count() > 1);
  const std::size_t d = width_ - 1;
  std::vector<double> positions(handles.size() * d), weights(handles.size());
  share(handles.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const double* const row = row_of(handles[k]);
      copy_point(row, d, &positions[k * d]);
      weights[k] = row[d];
    }
  });
  diagram.set_seeds({measures_.dimension, positions, weights});
  // Of a large shard most cells are far from all others, so that their geometry is not needed.
  if (round_ == 0 && own_.size() >= least_with_far_cells[width_ - 3]) {
    compute(diagram, handles, {.reach = true, .unproved = true});
    std::vector<double> reach(own_.size());
    for (std::size_t k = 0; k < open_.size(); ++k) reach[open_[k]] = (*diagram.results->reach)[k];
    close_far_cells(reach);
  }
  if (!open_.empty()) {
    requests = ask_all(diagram, handles, {.cells = true, .unproved = true});
    // Cells that reach far because others are not at hand yet need no images there.
    if (requests.empty() && !unproved_.empty()) requests = ask_all(diagram, handles, {.cells = true});
  }
  foreign_clipped_ = foreign_id_.size();
  all_needed_ = false;
  ++round_;
  return requests;
}

std::map<int, Request> Shard::ask_all(Diagram::State& diagram, std::span<const Handle> handle, Wanted want) {
  compute(diagram, handle, want);
  std::map<int, Request> requests;
  NearBoxes near(others_, moves_);
  for (std::size_t k = 0; k < open_.size(); ++k)
    if (measures_.status[open_[k]] == SeedStatus::ok) ask(*diagram.results->cells, k, handle, near, requests);
  return requests;
}

void Shard::compute(Diagram::State& diagram, std::span<const Handle> handle, Wanted want) {
  const std::size_t d = width_ - 1;
  std::vector<std::uint32_t> index(own_.size()), selected;
  for (std::uint32_t k = 0; k < handle.size(); ++k)
    if (is_own(handle[k])) index[handle[k]] = k;
  for (const Handle cell : open_) selected.push_back(index[cell]);
  clipped_ += selected.size();
  diagram.select(selected);
  want.adjacency = true;
  want.walls = lists_walls_;
  diagram.compute(want);
  const Measures& from = *diagram.results->measures;
  Adjacency& adjacency = *diagram.results->adjacency;
  share(open_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Handle cell = open_[k];
      measures_.mass[cell] = from.mass[k];
      copy_point(&from.centroid[k * d], d, &measures_.centroid[cell * d]);
      measures_.second_moment[cell] = from.second_moment[k];
      measures_.status[cell] = from.status[k];
      if (from.status[k] != SeedStatus::ok) own_.set_hidden(cell);
      rows_[cell] = {adjacency.offset[k],
                     static_cast<std::uint32_t>(adjacency.offset[k + 1] - adjacency.offset[k]),
                     static_cast<std::uint32_t>(walls_.size())};
    }
  });
  share(adjacency.neighbor.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) adjacency.neighbor[k] = handle[adjacency.neighbor[k]];
  });
  unproved_.clear();
  for (const std::uint32_t k : diagram.results->unproved)
    if (from.status[k] == SeedStatus::ok) unproved_.push_back(open_[k]);
  walls_.push_back({std::move(adjacency.neighbor), std::move(adjacency.wall), std::move(adjacency.shift)});
}

void Shard::close_far_cells(const std::vector<double>& reach) {
  const NearBoxes near(others_, moves_);
  const PackedTree& tree = own_.tree();
  std::vector<std::uint8_t> is_near(own_.size());
  const auto look_at = [&](std::uint32_t leaf) {
    // Few leaves are near others, and what can cut none of their cells is found for all of them at once.
    double most = least_radius;
    for (const std::uint32_t cell : own_.in_leaf(leaf)) most = std::max(most, reach[cell]);
    const auto may_meet = [&](const Point& move) {
      const Box box = moved(box_of(tree, leaf), move, width_ - 1);
      return near.may_meet(box.view(), farthest_cell(own_.in_tree(), leaf, box.view(), most));
    };
    if (std::none_of(moves_.begin(), moves_.end(), may_meet)) return;
    for (const std::uint32_t cell : own_.in_leaf(leaf))
      if (measures_.status[cell] == SeedStatus::ok)
        is_near[cell] = near.may_meet(own_.wrapped_row(cell), std::max(reach[cell], least_radius));
  };
  const std::size_t leaves = tree.level_offset[1];
  parallel_for(threads_for(leaves, threads_, shared_leaves), leaves, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) look_at(static_cast<std::uint32_t>(leaf));
  });
  for (const Handle cell : unproved_) is_near[cell] = 1;
  std::erase_if(open_, [&](Handle cell) { return is_near[cell] == 0; });
}

bool Shard::keep_nearest(NearBoxes& near, const Point& vertex) {
  if (round_ > 0 || asked_.size() < 2) return true;
  const std::size_t all = asked_.size();
  for (double along = 0.5; asked_.size() > 1 && along > 1e-3; along /= 2) {
    const Point at{along * vertex[0], along * vertex[1], along * vertex[2]};
    std::vector<NearBoxes::View> nearer;
    for (const NearBoxes::View& view : asked_)
      if (near.may_cut_at(view, at)) nearer.push_back(view);
    if (nearer.empty()) break;
    asked_ = std::move(nearer);
  }
  return asked_.size() == all;
}

void Shard::add_vertex(const double* row, double radius, const Point& vertex, Request& request) const {
  // Vertices of a cell are one after the other.
  const auto last = request.cell.end() - (request.cell.empty() ? 0 : static_cast<std::ptrdiff_t>(width_) + 1);
  if (last == request.cell.end() || !std::equal(row, row + width_, last)) {
    request.cell.insert(request.cell.end(), row, row + width_);
    request.cell.push_back(radius);
    request.end.push_back(request.end.empty() ? 0 : request.end.back());
  }
  for (std::size_t k = 0; k + 1 < width_; ++k)
    request.vertex.push_back(static_cast<float>(vertex[k] / radius));
  ++request.end.back();
}

double Shard::radius_about(const Cells& cells, std::size_t row, Handle cell) const {
  const double* const seed = own_.row(cell);
  double rounding = 0;  // of vertices, whose coordinates are about those of the seed as given
  for (std::size_t k = 0; k + 1 < width_; ++k) rounding += coordinate_error * std::abs(seed[k]);
  return std::max(radius_of(cells, row, seed), moves_.size() > 1 ? rounding / vertex_error : 0);
}

void Shard::ask(const Cells& cells, std::size_t row, std::span<const Handle> handle, NearBoxes& near,
                std::map<int, Request>& requests) {
  const Handle self = open_[row];
  const double radius = radius_about(cells, row, self);
  near.set(own_.wrapped_row(self), radius);
  if (near.empty()) return;
  cell_vertices_.set(cells, row, own_.row(self), self, handle);
  // Of a cell that reaches far, most vertices are cut off by what others are answered with.
  const std::size_t most = near.few() ? cell_vertices_.size() : far_vertices, before = waiting_for_.size();
  bool postponed = false;
  for (std::size_t v = 0; v < cell_vertices_.size(); ++v) {
    const Point& at = cell_vertices_.offset(v);
    near.views_at(at, asked_);
    if (asked_.empty()) continue;
    Vertex& vertex = vertices_[cell_vertices_.name(v)];
    if (vertex.settled) continue;
    postponed = waiting_for_.size() - before == most;
    if (postponed) break;
    if (vertex.round <= round_) {
      vertex = {round_ + 1, keep_nearest(near, at), false, false};
      questions_.push_back(&vertex);
      for (const NearBoxes::View& view : asked_) {
        add_vertex(near.row(view).data(), radius, at, requests[view.shard]);
        asked_of_[view.shard].push_back(&vertex);
      }
    }
    waiting_for_.push_back(&vertex);
  }
  if (waiting_for_.size() > before) waiting_.push_back({self, waiting_for_.size(), postponed});
}

std::map<int, BoundaryLeaves> Shard::boundaries() const {
  std::map<int, BoundaryLeaves> boundaries;
  for (const auto& [shard, part] : near_parts_) {
    BoundaryLeaves boundary = own_.boundary(others_.unsent_of(shard), moves_);
    if (boundary.leaves() > 0) boundaries.emplace(shard, std::move(boundary));
  }
  return boundaries;
}

void Shard::take(int from, Halo&& halo) {
  take_seeds(halo.id, halo.seed);
  others_.take_unsent(from, std::move(halo.unsent));
}

void Shard::take_seeds(const std::vector<std::uint64_t>& ids, const std::vector<double>& rows) {
  foreign_id_.insert(foreign_id_.end(), ids.begin(), ids.end());
  foreign_rows_.insert(foreign_rows_.end(), rows.begin(), rows.end());
  foreign_hidden_.resize(foreign_id_.size());
}

void Shard::take(int from, Reply&& reply) {
  take_seeds(reply.id, reply.seed);
  if (reply.coarse_tree.levels() > 0) take(from, std::move(reply.coarse_tree));
  const std::vector<Vertex*>& asked = asked_of_.at(from);
  for (std::size_t v = 0; v < asked.size(); ++v)
    if (reply.found[v] != 0) asked[v]->found = true;
}

void Shard::settle() {
  for (Vertex* const vertex : questions_) vertex->settled = vertex->all_asked && !vertex->found;
  open_ = std::exchange(unproved_, {});
  all_needed_ = !open_.empty();  // images may be missing among their walls
  const auto unproved = static_cast<std::ptrdiff_t>(open_.size());
  std::size_t begin = 0;
  for (const Waiting& cell : waiting_) {
    const auto first = waiting_for_.begin() + static_cast<std::ptrdiff_t>(begin),
               last = waiting_for_.begin() + static_cast<std::ptrdiff_t>(cell.end);
    begin = cell.end;
    if (cell.postponed || !std::all_of(first, last, [](const Vertex* vertex) { return vertex->settled; }))
      open_.push_back(cell.cell);
  }
  std::inplace_merge(open_.begin(), open_.begin() + unproved, open_.end());
  open_.erase(std::unique(open_.begin(), open_.end()), open_.end());
  waiting_.clear();
  waiting_for_.clear();
  questions_.clear();
  asked_of_.clear();
}

void Shard::forget(const std::vector<std::uint64_t>& ids) {
  if (ids.empty()) return;
  const std::unordered_set<std::uint64_t> gone(ids.begin(), ids.end());
  for (std::size_t k = 0; k < foreign_id_.size(); ++k)
    if (gone.contains(foreign_id_[k])) foreign_hidden_[k] = 1;
}

void Shard::reopen() {
  std::mutex adds;
  share(own_.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Handle> found;
    for (std::size_t cell = begin; cell < end; ++cell) {
      if (measures_.status[cell] != SeedStatus::ok) continue;
      const std::span<const Handle> neighbors = neighbors_of(static_cast<Handle>(cell));
      if (std::any_of(neighbors.begin(), neighbors.end(), [this](Handle h) { return is_gone(h); }))
        found.push_back(static_cast<Handle>(cell));
    }
    const std::lock_guard lock(adds);
    open_.insert(open_.end(), found.begin(), found.end());
  });
  std::sort(open_.begin(), open_.end());
  all_needed_ = !open_.empty();
}

std::map<int, Duplicates> Shard::duplicates() const {
  std::map<int, Duplicates> questions;
  for (Handle cell = 0; cell < own_.size(); ++cell) {
    if (measures_.status[cell] != SeedStatus::hidden) continue;
    const double* const row = own_.wrapped_row(cell);
    const auto open = [row](const PackedTree& boxes, std::uint32_t node) {
      return contains(boxes, node, row);
    };
    others_.visit(open, [&](int shard) {
      if (!may_contain(others_.all_of(shard), row)) return true;
      Duplicates& duplicates = questions[shard];
      duplicates.id.push_back(own_.id(cell));
      duplicates.seed.insert(duplicates.seed.end(), row, row + width_);
      return true;
    });
  }
  return questions;
}

void Shard::mark_duplicates(const Duplicates& asked, const std::vector<std::uint8_t>& better) {
  std::size_t at = 0;
  for (std::size_t k = 0; k < better.size(); ++k) {
    while (own_.id(at) != asked.id[k]) ++at;
    if (better[k] != 0) measures_.status[at] = SeedStatus::duplicate;
  }
}

ShardCells Shard::take_cells(double domain_measure) {
  const std::size_t n = own_.size();
  ShardCells cells;
  cells.measures = take_measures();
  cells.measures.domain_measure = domain_measure;
  cells.offset.resize(n + 1);
  for (std::size_t i = 0; i < n; ++i) cells.offset[own_.given(i) + 1] = rows_[i].count;
  std::partial_sum(cells.offset.begin(), cells.offset.end(), cells.offset.begin());
  if (!lists_walls_) return cells;
  const bool is_periodic = moves_.size() > 1;
  if (is_periodic) resize_populated(cells.shift, cells.offset.back(), threads_);
  resize_populated(cells.neighbor, cells.offset.back(), threads_);
  resize_populated(cells.wall, cells.offset.back(), threads_);
  share(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::span<const Handle> neighbors = neighbors_of(static_cast<Handle>(i));
      if (neighbors.empty()) continue;
      const std::uint64_t at = cells.offset[own_.given(i)];
      std::transform(neighbors.begin(), neighbors.end(), &cells.neighbor[at],
                     [this](Handle h) { return id_of(h); });
      const Walls& walls_of = walls_[rows_[i].walls];
      std::copy_n(&walls_of.wall[rows_[i].begin], neighbors.size(), &cells.wall[at]);
      if (is_periodic) std::copy_n(&walls_of.shift[rows_[i].begin], neighbors.size(), &cells.shift[at]);
    }
  });
  return cells;
}

Measures Shard::take_measures() {
  if (own_.given_in_order()) return std::move(measures_);
  const std::size_t d = width_ - 1, n = own_.size();
  Measures measures = measures_;
  share(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t at = own_.given(i);
      measures.mass[at] = measures_.mass[i];
      measures.second_moment[at] = measures_.second_moment[i];
      measures.status[at] = measures_.status[i];
      copy_point(&measures_.centroid[i * d], d, &measures.centroid[at * d]);
    }
  });
  return measures;
}

std::vector<std::uint64_t> Shard::foreign_neighbors() const {
  std::vector<std::uint8_t> found(foreign_id_.size());
  std::mutex adds;
  share(own_.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Handle> foreign;  // few cells have some, so that each may be there many times
    for (std::size_t cell = begin; cell < end; ++cell)
      for (const Handle neighbor : neighbors_of(static_cast<Handle>(cell)))
        if (!is_own(neighbor)) foreign.push_back(neighbor);
    const std::lock_guard lock(adds);
    for (const Handle neighbor : foreign) found[neighbor - own_.size()] = 1;
  });
  std::vector<std::uint64_t> ids;
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k] != 0) ids.push_back(foreign_id_[k]);
  return ids;
}

}  // namespace powercell::exchange
