// What the host does where kernels decide (kernels/base/decide.cl): vertices are placed by their planes when
// they come to be, with an error; a side that this error leaves open is decided exactly. Included inside the
// namespace of a host clipper, after the cell.

/// What lies behind the faces at a vertex.
template <class Cell>
ExactVertex vertex_planes(const Cell* cell, int v) {
  if constexpr (requires { cell->previous; }) {
    return {cell->border[cell->previous[v]], cell->border[v], 0};
  } else {
    return {cell->border[cell->face[0][v]], cell->border[cell->face[1][v]], cell->border[cell->face[2][v]]};
  }
}
inline bool is_corner(const ExactVertex& planes) {
  return planes[0] < 0 && planes[1] < 0 && (CELL_DIMENSION == 2 || planes[2] < 0);
}

/// Errors that vertices may have, in units of the cell's radius, before they are placed exactly: while others
/// are still to be cut off, and in the end.
constexpr real passing_error = 1e-7, final_error = 1e-12;

/// Planes known so far are to be found again: for another cell, or for the radius as it is now.
template <class Cell>
void forget_planes(Cell* cell) {
  if (++cell->round != 0) return;
  std::fill(cell->unit_of, cell->unit_of + cell->face_capacity, 0);
  cell->round = 1;
}

/// The plane of face f, or the line of edge f of a polygon, found once.
template <class Cell>
const certain_plane_t& known_plane(Cell* cell, int f) {
  const ulong found = static_cast<ulong>(cell->round) << 32 | static_cast<uint>(cell->border[f]);
  if (cell->unit_of[f] != found) {
    cell->unit_of[f] = found;
    if constexpr (requires { cell->previous; })
      cell->unit[f] = edge_line(cell, f, cell->ground.plane);
    else
      cell->unit[f] = face_plane(cell, f);
  }
  return cell->unit[f];
}

template <class Cell>
real4 placed_by_planes(Cell* cell, int v, real4 from) {
  if constexpr (requires { cell->previous; }) {
    return meeting_point(&cell->at, from, cell->ground,
                         known_plane(cell, static_cast<int>(cell->previous[v])), known_plane(cell, v));
  } else {
    return meeting_point(&cell->at, from, known_plane(cell, static_cast<int>(cell->face[0][v])),
                         known_plane(cell, static_cast<int>(cell->face[1][v])),
                         known_plane(cell, static_cast<int>(cell->face[2][v])));
  }
}

/// Places vertex v, whose planes are known, and notes its error.
template <class Cell>
void host_place(Cell* cell, int v, real good_error) {
  const ExactVertex planes = vertex_planes(cell, v);
  if (is_corner(planes)) {
    cell->error[v] = corner_error(&cell->at);
  } else {
    real4 y = placed_by_planes(cell, v, make_real4(0, 0, 0, 0));
    if (y.w >= 0) y = placed_by_planes(cell, v, make_real4(y.x, y.y, y.z, 0));
    if (!(y.w >= 0 && y.w <= good_error * cell->at.radius)) {
      const std::array<double, 3> exact = cell->exact->place(planes);
      y = {exact[0], exact[1], exact[2],
           4 * REAL_EPSILON * (fabs(exact[0]) + fabs(exact[1]) + fabs(exact[2]))};
    }
    cell->at.x[0][v] = y.x;
    cell->at.x[1][v] = y.y;
    if (DIMENSION == 3) cell->at.x[DIMENSION - 1][v] = y.z;
    cell->error[v] = y.w;
  }
  cell->worst_error = fmax(cell->worst_error, cell->error[v]);
  cell->moved = true;
}

template <class Cell>
void host_place(Cell* cell, int v) {
  host_place(cell, v, passing_error);
}

/// Before the first cut.
template <class Cell>
void host_start(Cell* cell) {
  if constexpr (requires { cell->previous; }) cell->ground = ground_plane(cell);
  forget_planes(cell);
  cell->moved = true;
  cell->at.gap = -REAL_MAX / 4;  // nothing is to be proved: gaps are not looked for
  cell->worst_error = corner_error(&cell->at);
  for (int v = 0; v < cell->at.blocks * LANES; ++v) cell->error[v] = cell->worst_error;
}

template <class Cell>
real host_tolerance(const Cell* cell, real sum, real q2, real dw) {
  return plane_error(&cell->at, sum, q2, dw) + 2 * sum * cell->worst_error;
}

/// Which vertices are outside the bisector with `border`, by side[] or exactly: none is in it. A bisector
/// that was tried before cannot cut any more.
template <class Cell>
int host_sides(Cell* cell, int border, int* vertices, int* inside) {
  vertices_t* const p = &cell->at;
  if (!cell->tried->insert(border)) {
    *vertices = *inside = 1;
    return 0;
  }
  if (cell->moved) find_radius2(p);
  cell->moved = false;
  const seed_t seed = p->seeds[p->self], other = p->seeds[border];
  real q[DIMENSION], sum = 0;
  difference(other, seed, q);
  for (const real c : q) sum += fabs(c);
  const real rounding = plane_error(p, sum, norm2(q), weight_difference(seed, other));
  int outside = 0, all = 0;
  for (int w = 0; w < words_of(p); ++w) {
    ulong out = 0, in = 0;
    for (int b = 8 * w; b < min(8 * w + 8, p->blocks); ++b) {
      const real8 s = load8(p->side + b * LANES);
      const real8 error = all_lanes(rounding) + all_lanes(2 * sum) * load8(cell->error + b * LANES);
      out |= static_cast<ulong>(lane_bits(s > error)) << b % 8 * 8;
      in |= static_cast<ulong>(lane_bits(s < -error)) << b % 8 * 8;
    }
    out &= p->used[w];
    for (ulong doubt = p->used[w] & ~(out | in); doubt != 0; doubt &= doubt - 1) {
      const int bit = lowest_bit(doubt);
      if (cell->exact->is_outside(vertex_planes(cell, w * WORD_BITS + bit), border)) out |= (ulong)1 << bit;
    }
    p->outside[w] = out;
    outside += popcount(out);
    all += popcount(p->used[w]);
  }
  *vertices = all;
  *inside = all - outside;
  return outside;
}

/// Vertices of the finished cell as good as they can be.
template <class Cell>
bool host_finish(Cell* cell) {
  find_radius2(&cell->at);
  forget_planes(cell);
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1)
      host_place(cell, w * WORD_BITS + lowest_bit(bits), final_error);
  return true;
}

/// Of faces or cells this part of the square or cube of the radius large, the dimension is not in doubt.
constexpr real plainly_solid = 1e-9;

/// Whether the ends of an edge are one point without the infinitesimals of ties: then the plane that u has
/// and v does not have holds v too.
template <class Cell>
bool coincide(const Cell* cell, int v, int u) {
  real distance = 0;
  for (int k = 0; k < DIMENSION; ++k) distance = fmax(distance, fabs(cell->at.x[k][v] - cell->at.x[k][u]));
  if (distance > 2 * (cell->error[v] + cell->error[u])) return false;
  const ExactVertex here = vertex_planes(cell, v), there = vertex_planes(cell, u);
  const auto end = here.begin() + CELL_DIMENSION;
  const auto* other = std::find_if(there.begin(), there.begin() + CELL_DIMENSION - 1,
                                   [&](int border) { return std::find(here.begin(), end, border) == end; });
  return cell->exact->lies_in(here, *other);
}

/// Calls use(v, u, border) for the edges from v to u of face f, or of a polygon (f does not count), each in
/// the plane of `border`, while it returns true; whether all did. Needs cell_finish.
template <class Cell, class Use>
bool all_edges(const Cell* cell, int f, const Use& use) {
  if constexpr (requires { cell->previous; }) {
    for (int v = cell->first;;) {
      const int u = static_cast<int>(cell->next[v]);
      if (!use(v, u, cell->border[v])) return false;
      if ((v = u) == cell->first) return true;
    }
  } else {
    for (int v = static_cast<int>(cell->mark[f]);;) {
      int k = 0;
      while (static_cast<int>(cell->face[k][v]) != f) ++k;
      const int u = static_cast<int>(cell->next[k][v]);
      if (!use(v, u, cell->border[cell->face[k == 0 ? 2 : k - 1][v]])) return false;
      if ((v = u) == static_cast<int>(cell->mark[f])) return true;
    }
  }
}

/// Whether a face, or a polygon, has no area without the infinitesimals: all edges with a length are
/// parallel.
template <class Cell>
bool has_no_area(const Cell* cell, int f) {
  const int face = CELL_DIMENSION == 3 ? cell->border[f] : 0;
  int first = 0;
  bool any = false;
  return all_edges(cell, f, [&](int v, int u, int border) {
    if (coincide(cell, v, u)) return true;
    if (any) return cell->exact->are_parallel(face, first, border);
    any = true;
    first = border;
    return true;
  });
}

/// Whether the wall that is face f, or edge f of a polygon, measures nothing without the infinitesimals.
template <class Cell>
bool is_degenerate_wall(const Cell* cell, int f) {
  if constexpr (requires { cell->previous; })
    return coincide(cell, f, static_cast<int>(cell->next[f]));
  else
    return has_no_area(cell, f);
}

/// Whether the cell measures nothing without the infinitesimals.
template <class Cell>
bool is_degenerate_cell(const Cell* cell) {
  if constexpr (requires { cell->previous; }) {
    return has_no_area(cell, 0);
  } else {
    for (int f = 0; f < cell_faces(cell); ++f) {
      if (has_no_area(cell, f)) continue;
      for (int w = 0; w < words_of(&cell->at); ++w)
        for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1)
          if (!cell->exact->lies_in(vertex_planes(cell, w * WORD_BITS + lowest_bit(bits)), cell->border[f]))
            return false;
    }
    return true;
  }
}

/// Whether vertex v is an end of face f, or of edge f of a polygon.
template <class Cell>
bool is_on_face(const Cell* cell, int v, int f) {
  if constexpr (requires { cell->previous; })
    return v == f || static_cast<int>(cell->previous[v]) == f;
  else
    return static_cast<int>(cell->face[0][v]) == f || static_cast<int>(cell->face[1][v]) == f ||
           static_cast<int>(cell->face[2][v]) == f;
}

/// Faces in the order in which they are written; edges go around the ring.
template <class Cell>
int first_face(const Cell& cell) {
  if constexpr (requires { cell.first; }) return cell.first;
  return 0;
}
template <class Cell>
int after_face(const Cell& cell, int f) {
  if constexpr (requires { cell.first; }) return static_cast<int>(cell.next[f]);
  return f + 1;
}

/// Facet f of the region the cell started as.
template <class Cell>
certain_plane_t facet_of_region(const Cell* cell, int f) {
  if constexpr (requires { cell->previous; })
    return facet_line(cell, f, ground_plane(cell).plane);
  else
    return region_plane(cell, f);
}

/// Area of the surface, or length of the outline. Needs cell_moments.
template <class Cell>
real surface_of(const Cell* cell) {
  real sum = 0;
  if constexpr (requires { cell->previous; }) {
    all_edges(cell, 0, [&](int v, int u, int) {
      real square = 0;
      for (const auto& x : cell->at.x) square += (x[u] - x[v]) * (x[u] - x[v]);
      sum += sqrt(square);
      return true;
    });
  } else {
    for (int f = 0; f < cell->faces; ++f) sum += cell->at.side[f];
  }
  return sum;
}

/// Whether the cell is exactly flat. What is not, but is no thicker than rounding of its vertices, gets the
/// least measure there is and its vertices' mean for its centroid.
template <class Cell>
bool host_is_flat(const Cell* cell, real* moments) {
  const real r = cell->at.radius;
  if (moments[0] > plainly_solid * (CELL_DIMENSION == 3 ? r * r * r : r * r)) return false;
  if (is_degenerate_cell(cell)) return true;
  if (moments[0] > 64 * REAL_EPSILON * r * surface_of(cell)) return false;
  moments[0] = fmax(moments[0], std::numeric_limits<real>::min());
  real mean2 = 0;
  for (int k = 0; k < DIMENSION; ++k) {
    real sum = 0;
    int count = 0;
    for (int w = 0; w < words_of(&cell->at); ++w)
      for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1, ++count)
        sum += cell->at.x[k][w * WORD_BITS + lowest_bit(bits)];
    moments[1 + k] = moments[0] * (sum / count);
    mean2 += (sum / count) * (sum / count);
  }
  moments[1 + DIMENSION] = moments[0] * mean2;
  return false;
}
