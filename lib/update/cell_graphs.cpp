#include "lib/update/cell_graphs.hpp"

#include <algorithm>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

template <int D>
std::uint32_t CellGraphs<D>::place_of(std::vector<Mark>& marks, std::uint32_t what,
                                      std::vector<std::uint32_t>& list) {
  Mark& mark = marks[what];
  if (mark.cell == cell_) return mark.place;
  mark = {cell_, static_cast<std::uint32_t>(list.size())};
  list.push_back(what);
  return mark.place;
}

/// \return whether the cell has a graph
template <int D>
bool CellGraphs<D>::find_star(std::uint32_t site) {
  if (simplex_mark_.size() < mesh_.simplex_count()) simplex_mark_.resize(mesh_.simplex_count(), {0, 0});
  if (site_mark_.size() < mesh_.sites().size()) site_mark_.resize(mesh_.sites().size(), {0, 0});
  if (++cell_ == 0) {  // all numbers are used up
    std::fill(simplex_mark_.begin(), simplex_mark_.end(), Mark{0, 0});
    std::fill(site_mark_.begin(), site_mark_.end(), Mark{0, 0});
    cell_ = 1;
  }
  simplices_.clear();
  faces_.clear();
  face_.clear();
  next_.clear();
  place_of(simplex_mark_, mesh_.simplex_at(site), simplices_);
  for (std::size_t v = 0; v != simplices_.size();) {  // which grow
    const auto& simplex = mesh_.simplex(simplices_[v++]);
    const std::size_t own = mesh_.index_of(simplex.corner, site);
    if constexpr (D == 2) {
      // Counter-clockwise: across the facet opposite the first of the other corners.
      faces_.push_back(simplex.corner[(own + 2) % 3]);
      place_of(simplex_mark_, simplex.across[(own + 1) % 3] / 4, simplices_);
    } else {
      std::array<std::uint8_t, 3> face{}, next{};
      for (std::size_t p = 0; p < 3; ++p) {
        const std::size_t at = tetrahedron_facet[own][p], leave = tetrahedron_facet[own][(p + 1) % 3];
        face[p] = static_cast<std::uint8_t>(place_of(site_mark_, simplex.corner[at], faces_));
        next[p] = static_cast<std::uint8_t>(place_of(simplex_mark_, simplex.across[leave] / 4, simplices_));
      }
      face_.push_back(face);
      next_.push_back(next);
    }
  }
  return simplices_.size() <= most_vertices;
}

template <int D>
void CellGraphs<D>::write_loops(std::uint8_t* sizes, std::uint8_t* loop) {
  std::array<std::uint8_t, most_vertices + 1> first;
  for (std::size_t v = simplices_.size(); v-- > 0;)
    for (const std::uint8_t f : face_[v]) first[f] = static_cast<std::uint8_t>(v);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    std::uint8_t v = first[f];
    const std::uint8_t* const begin = loop;
    do {
      *loop++ = v;
      v = next_[v][face_[v][0] == f ? 0 : face_[v][1] == f ? 1 : 2];
    } while (v != first[f]);
    sizes[f] = static_cast<std::uint8_t>(loop - begin);
  }
}

template <int D>
void CellGraphs<D>::write_row(std::uint32_t site) {
  const std::size_t need = words(simplices_.size(), faces_.size());
  std::uint64_t& row = row_[site - first_];
  const std::size_t had = row == none ? 0 : words(words_[row], words_[row + 1]);
  if (need > had) {
    unused_ += had;
    row = words_.size();
    words_.resize(words_.size() + need);
  } else {
    unused_ += had - need;
  }
  std::uint32_t* word = &words_[row];
  *word++ = static_cast<std::uint32_t>(simplices_.size());
  *word++ = static_cast<std::uint32_t>(faces_.size());
  word = std::copy(simplices_.begin(), simplices_.end(), word);
  word = std::copy(faces_.begin(), faces_.end(), word);
  if constexpr (D == 3) {
    auto* const sizes = reinterpret_cast<std::uint8_t*>(word);
    write_loops(sizes, sizes + (faces_.size() + 3) / 4 * 4);
  }
}

/// Rows that became smaller or moved leave gaps.
template <int D>
void CellGraphs<D>::compact() {
  std::vector<std::uint32_t> kept;
  kept.reserve(words_.size() - unused_);
  for (std::uint64_t& row : row_) {
    if (row == none) continue;
    const auto from = words_.begin() + static_cast<std::ptrdiff_t>(row);
    const std::size_t count = words(words_[row], words_[row + 1]);
    row = kept.size();
    kept.insert(kept.end(), from, from + static_cast<std::ptrdiff_t>(count));
  }
  words_ = std::move(kept);
  unused_ = 0;
}

template <int D>
CellGraph CellGraphs<D>::at(std::uint64_t row) const {
  const std::uint32_t* const word = &words_[row];
  const std::size_t vertices = word[0], faces = word[1];
  CellGraph graph{{word + 2, vertices}, {word + 2 + vertices, faces}, {}, {}};
  if constexpr (D == 3) {
    const auto* const sizes = reinterpret_cast<const std::uint8_t*>(word + 2 + vertices + faces);
    graph.loop_size = {sizes, faces};
    graph.loop = {sizes + (faces + 3) / 4 * 4, 3 * vertices};
  }
  return graph;
}

template <int D>
CellGraph CellGraphs<D>::graph(std::uint32_t site, bool changed) {
  std::uint64_t& row = row_[site - first_];
  if (row != none && !changed) return at(row);
  if (!find_star(site)) {
    if (row != none) unused_ += words(words_[row], words_[row + 1]);
    row = none;
    return {};
  }
  if (unused_ > words_.size() / 2 + 1024) compact();
  write_row(site);
  return at(row);
}

template class CellGraphs<2>;
template class CellGraphs<3>;

}  // namespace powercell
