// What the walls of a finished cell measure, and which lie in facets of its region (docs/mathematics.md,
// "Walls in facets"). Included inside the namespace of a host clipper, after Row.

/// A facet of the region that some vertex of the cell may lie in.
struct NearFacet {
  int facet;
  certain_plane_t plane;
  bool may_hold(const cell_t& cell, int v) const {
    real s = -plane.plane.w;
    const real n[3] = {plane.plane.x, plane.plane.y, plane.plane.z};
    for (int k = 0; k < DIMENSION; ++k) s += n[k] * cell.at.x[k][v];
    return fabs(s) <= final_error * cell.at.radius + cell.error[v] + plane.doubt;
  }
};

std::vector<NearFacet> near_facets(const cell_t& cell, int facets) {
  std::vector<NearFacet> near;
  for (int f = 0; f < facets; ++f) {
    const NearFacet facet{f, facet_of_region(&cell, f)};
    bool any = false;
    for (int w = 0; w < words_of(&cell.at); ++w)
      for (ulong bits = cell.at.used[w]; bits != 0 && !any; bits &= bits - 1)
        any = facet.may_hold(cell, w * WORD_BITS + lowest_bit(bits));
    if (any) near.push_back(facet);
  }
  return near;
}

/// The facets in whose plane face `face` lies: of a polygon whose corners are in line there may be several.
std::vector<int> facets_of_face(const cell_t& cell, int face, const std::vector<NearFacet>& near) {
  std::vector<int> facets;
  for (const NearFacet& facet : near) {
    bool within = true;
    for (int w = 0; w < words_of(&cell.at); ++w)
      for (ulong bits = cell.at.used[w]; bits != 0 && within; bits &= bits - 1) {
        const int v = w * WORD_BITS + lowest_bit(bits);
        within = !is_on_face(&cell, v, face) ||
                 (facet.may_hold(cell, v) && cell.exact->lies_in(vertex_planes(&cell, v), ~facet.facet));
      }
    if (within) facets.push_back(facet.facet);
  }
  return facets;
}

/// What lies behind a face with `border` in the plane of facet f, once ties have no thickness: the seed, if
/// it has the region behind the facet (or, for a flat piece, if the cell itself has it), else the facet
/// (docs/mathematics.md, "Walls in facets").
int border_in_facet(const cell_t& cell, int border, int f, bool flat) {
  const int behind = cell.at.behind[f];
  if (behind == BEHIND_NOTHING) return ~f;
  if (DIMENSION == CELL_DIMENSION) return border;
  return cell.exact->is_corner_outside(static_cast<uint>(behind), border) != flat ? border : ~f;
}

/// Of what is plainly a wall: far below rounding, far above the least number.
constexpr real next_to_nothing = 1e-50;

/// Walls whose measure is 0 without the infinitesimals of ties measure 0, to the bit, and no others: what
/// rounding made nothing measures next to nothing.
void settle_small_walls(const cell_t& cell, Row& row) {
  const real plain = plainly_solid * (CELL_DIMENSION == 3 ? cell.at.radius * cell.at.radius : cell.at.radius);
  int face = first_face(cell);
  for (std::size_t k = 0; k < row.faces; ++k) {
    if (!(row.wall[k] > plain))
      row.wall[k] = is_degenerate_wall(&cell, face) ? 0 : fmax(row.wall[k], next_to_nothing * plain);
    face = after_face(cell, face);
  }
}

#if DIMENSION == 2
/// Whether a wall that is edge `face` of a polygon ends before facet f does, or where it begins: exactly.
bool ends_before(const cell_t& cell, int face, int f) {
  const auto before = static_cast<int>(cell.previous[face]), behind = static_cast<int>(cell.next[face]);
  for (const int border : {cell.border[before], cell.border[behind]})
    if (border >= 0 && cell.exact->is_facet_outside(static_cast<uint>(f), border)) return true;
  return false;
}

/// Of a wall in the line of several facets only what has a region behind it is one: its length, below 0 if
/// that is all of it.
real open_length(const cell_t& cell, int face, const std::vector<int>& facets, real least) {
  const int end = static_cast<int>(cell.next[face]);
  real way[2] = {cell.at.x[0][end] - cell.at.x[0][face], cell.at.x[1][end] - cell.at.x[1][face]};
  const real length = hypot(way[0], way[1]);
  const auto place = [&](const real4& corner) {
    return ((corner.x - cell.at.x[0][face]) * way[0] + (corner.y - cell.at.x[1][face]) * way[1]) / length;
  };
  real open = 0;
  bool closed = false;
  for (const int f : facets) {
    if (ends_before(cell, face, f)) continue;
    if (cell.at.behind[f] == BEHIND_NOTHING) {
      closed = true;
      continue;
    }
    const real from = place(region_corner(&cell.at, f)),
               to = place(region_corner(&cell.at, f + 1 == cell.corners ? 0 : f + 1));
    open += fmax(fmin(length, fmax(from, to)) - fmax(0, fmin(from, to)), least);
  }
  return closed ? fmin(open, length) : -1;
}
#endif

void settle_walls_in_facets(const cell_t& cell, int facets, bool flat, Row& row) {
  const std::vector<NearFacet> near = near_facets(cell, facets);
  if (near.empty()) return;
  int face = first_face(cell);
  for (std::size_t k = 0; k < row.faces; ++k, face = after_face(cell, face)) {
    if (row.border[k] < 0 || row.wall[k] == 0) continue;
    const std::vector<int> in = facets_of_face(cell, face, near);
    if (in.empty()) continue;
#if DIMENSION == 2
    if (in.size() > 1) {
      const real open = open_length(cell, face, in, next_to_nothing * row.wall[k]);
      if (open > 0) row.wall[k] = open;
      if (open != 0) continue;
    }
#endif
    row.border[k] = border_in_facet(cell, row.border[k], in.front(), flat);
  }
}
