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

template <class Cell>
real4 placed_by_planes(const Cell* cell, int v) {
  if constexpr (requires { cell->previous; }) {
    const certain_plane_t ground = ground_plane(cell);
    return meeting_point(&cell->at, ground,
                         edge_line(cell, static_cast<int>(cell->previous[v]), ground.plane),
                         edge_line(cell, v, ground.plane));
  } else {
    return meeting_point(&cell->at, face_plane(cell, static_cast<int>(cell->face[0][v])),
                         face_plane(cell, static_cast<int>(cell->face[1][v])),
                         face_plane(cell, static_cast<int>(cell->face[2][v])));
  }
}

/// Places vertex v, whose planes are known, and notes its error.
template <class Cell>
void host_place(Cell* cell, int v, real good_error) {
  const ExactVertex planes = vertex_planes(cell, v);
  if (is_corner(planes)) {
    cell->error[v] = corner_error(&cell->at);
  } else {
    real4 y = placed_by_planes(cell, v);
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
}

template <class Cell>
void host_place(Cell* cell, int v) {
  host_place(cell, v, passing_error);
}

/// Before the first cut.
template <class Cell>
void host_start(Cell* cell) {
  cell->worst_error = corner_error(&cell->at);
  for (int v = 0; v < cell->at.blocks * LANES; ++v) cell->error[v] = cell->worst_error;
}

template <class Cell>
real host_tolerance(const Cell* cell, real sum, real q2, real dw) {
  return plane_error(&cell->at, sum, q2, dw) + 2 * sum * cell->worst_error;
}

/// Which vertices are outside the bisector with `border`, by side[] or exactly: none is in it.
template <class Cell>
int host_sides(Cell* cell, int border, int* vertices, int* inside) {
  vertices_t* const p = &cell->at;
  find_radius2(p);
  const seed_t seed = p->seeds[p->self], other = p->seeds[border];
  real q[DIMENSION], sum = 0;
  difference(other, seed, q);
  for (const real c : q) sum += fabs(c);
  const real rounding = plane_error(p, sum, norm2(q), weight_difference(seed, other));
  int outside = 0, all = 0;
  for (int w = 0; w < words_of(p); ++w) {
    p->outside[w] = 0;
    for (ulong bits = p->used[w]; bits != 0; bits &= bits - 1) {
      const int bit = lowest_bit(bits), v = w * WORD_BITS + bit;
      ++all;
      const bool certain = fabs(p->side[v]) > rounding + 2 * sum * cell->error[v];
      if (!(certain ? p->side[v] > 0 : cell->exact->is_outside(vertex_planes(cell, v), border))) continue;
      p->outside[w] |= (ulong)1 << bit;
      ++outside;
    }
  }
  *vertices = all;
  *inside = all - outside;
  return outside;
}

/// Vertices of the finished cell as good as they can be.
template <class Cell>
bool host_finish(Cell* cell) {
  find_radius2(&cell->at);
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1)
      host_place(cell, w * WORD_BITS + lowest_bit(bits), final_error);
  return true;
}

/// Of faces or cells this part of the square or cube of the radius large, the dimension is not in doubt.
constexpr real plainly_solid = 1e-9;

/// The vertices of face f (an edge of a polygon), or of the cell for f = -1.
template <class Cell>
std::vector<int> vertices_of_face(const Cell* cell, int f) {
  std::vector<int> vertices;
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      bool on = f < 0;
      if constexpr (requires { cell->previous; }) {
        on = on || v == f || static_cast<int>(cell->previous[v]) == f;
      } else {
        for (const auto& face : cell->face) on = on || static_cast<int>(face[v]) == f;
      }
      if (on) vertices.push_back(v);
    }
  return vertices;
}

/// Whether those vertices span less than `dimension`.
template <class Cell>
bool is_degenerate(const Cell* cell, int f, int dimension) {
  std::vector<ExactVertex> vertices;
  for (const int v : vertices_of_face(cell, f)) vertices.push_back(vertex_planes(cell, v));
  return cell->exact->hull_dimension(vertices) < dimension;
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

/// Whether the cell is exactly flat. What is not, but measures nothing to rounding, gets the least measure
/// there is and its vertices' mean for its centroid.
template <class Cell>
bool host_is_flat(const Cell* cell, real* moments) {
  const real r = cell->at.radius;
  if (moments[0] > plainly_solid * (CELL_DIMENSION == 3 ? r * r * r : r * r)) return false;
  if (is_degenerate(cell, -1, CELL_DIMENSION)) return true;
  const real noise = 64 * REAL_EPSILON * (CELL_DIMENSION == 3 ? r * r * r : r * r);
  if (moments[0] > noise) return false;
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
