#include "lib/diagram/selection.hpp"

#include <algorithm>
#include <powercell/error.hpp>
#include <string>

#include "lib/base/memory.hpp"
#include "lib/base/positions.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

constexpr std::uint32_t no_place = ~std::uint32_t{0};

/// By the caller's index: the place in the selection, or no_place.
std::vector<std::uint32_t> places(const Selection& selection, std::size_t count) {
  std::vector<std::uint32_t> place(count, no_place);
  for (std::uint32_t k = 0; k < selection.size(); ++k) place[selection[k]] = k;
  return place;
}

template <class T>
void append_rows(const std::vector<T>& all, const Selection& selection, std::size_t width,
                 std::vector<T>& to) {
  to.reserve(selection.size() * width);
  for (const std::uint32_t i : selection)
    to.insert(to.end(), all.begin() + static_cast<std::ptrdiff_t>(i * width),
              all.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
}

}  // namespace

Selection checked_selection(std::span<const std::uint32_t> seeds, std::size_t count) {
  std::vector<std::uint8_t> seen(count);
  const auto refuse = [](std::size_t entry, const std::string& why) {
    throw Error(ErrorCode::invalid_argument,
                "entry " + std::to_string(entry) + " of the selection is " + why);
  };
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    if (seeds[k] >= count)
      refuse(k, std::to_string(seeds[k]) + ", and there are " + std::to_string(count) +
                    " seeds, counted from 0");
    if (seen[seeds[k]] != 0) refuse(k, "seed " + std::to_string(seeds[k]) + " again; select each seed once");
    seen[seeds[k]] = 1;
  }
  return {seeds.begin(), seeds.end()};
}

SelectedRows make_rows(const Selection& selection, const SeedSet& seeds, std::uint32_t own, int threads) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  const std::vector<std::uint32_t> place = places(selection, seeds.input_count);
  SelectedRows rows;
  rows.seeds.dimension = seeds.dimension;
  rows.seeds.input_count = selection.size();
  rows.rank.reserve(selection.size());
  rows.seeds.input.reserve(selection.size());
  for (std::uint32_t rank = 0; rank < own; ++rank) {
    const std::uint32_t at = place[seeds.input[rank]];
    if (at == no_place) continue;
    rows.rank.push_back(rank);
    rows.seeds.input.push_back(at);
  }
  const std::size_t count = rows.rank.size();
  resize_populated(rows.seeds.weights, count, threads);
  resize_populated(rows.seeds.positions, count * d, threads);
  parallel_for(threads_for(count, threads), count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      rows.seeds.weights[row] = seeds.weights[rows.rank[row]];
      copy_point(&seeds.positions[rows.rank[row] * d], d, &rows.seeds.positions[row * d]);
    }
  });
  for (const std::uint32_t i : seeds.duplicate)
    if (place[i] != no_place) rows.seeds.duplicate.push_back(place[i]);
  std::sort(rows.seeds.duplicate.begin(), rows.seeds.duplicate.end());
  return rows;
}

Measures select_rows(const Measures& all, const Selection& selection) {
  Measures rows;
  rows.dimension = all.dimension;
  rows.domain_measure = all.domain_measure;
  append_rows(all.mass, selection, 1, rows.mass);
  append_rows(all.centroid, selection, static_cast<std::size_t>(all.dimension), rows.centroid);
  append_rows(all.second_moment, selection, 1, rows.second_moment);
  append_rows(all.status, selection, 1, rows.status);
  return rows;
}

Adjacency select_rows(const Adjacency& all, const Selection& selection) {
  Adjacency rows;
  rows.offset.push_back(0);
  for (const std::uint32_t i : selection) {
    const auto begin = static_cast<std::ptrdiff_t>(all.offset[i]),
               end = static_cast<std::ptrdiff_t>(all.offset[i + 1]);
    rows.neighbor.insert(rows.neighbor.end(), all.neighbor.begin() + begin, all.neighbor.begin() + end);
    rows.wall.insert(rows.wall.end(), all.wall.begin() + begin, all.wall.begin() + end);
    rows.offset.push_back(rows.neighbor.size());
  }
  return rows;
}

JoinedCells select_rows(const JoinedCells& all, const Selection& selection) {
  JoinedCells rows;
  rows.dimension = all.dimension;
  rows.cell_dimension = all.cell_dimension;
  rows.vertex_offset = rows.face_offset = rows.loop_offset = {0};
  const auto append = [](auto& to, const auto& from, std::uint64_t begin, std::uint64_t end) {
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
              from.begin() + static_cast<std::ptrdiff_t>(end));
  };
  for (const std::uint32_t i : selection) {
    const std::uint64_t first = all.face_offset[i], last = all.face_offset[i + 1];
    append(rows.vertices, all.vertices, 3 * all.vertex_offset[i], 3 * all.vertex_offset[i + 1]);
    append(rows.face_border, all.face_border, first, last);
    for (std::uint64_t f = first; f < last; ++f) {
      append(rows.loop, all.loop, all.loop_offset[f], all.loop_offset[f + 1]);
      rows.loop_offset.push_back(rows.loop.size());
    }
    rows.vertex_offset.push_back(rows.vertices.size() / 3);
    rows.face_offset.push_back(rows.face_border.size());
  }
  return rows;
}

}  // namespace powercell
