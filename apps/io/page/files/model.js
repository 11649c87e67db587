// The diagram as the picture needs it: triangles, and for each cell a ball around it.
import { triangulate } from "./triangles.js";

/** Bounds of the corners of each cell: the middle and half the diagonal of its box. */
function balls(diagram) {
  const { points, corners, sizes, inner, outer } = diagram.arrays;
  const d = diagram.dimension;
  const n = diagram.seeds;
  const low = new Float32Array(3 * n).fill(Infinity);
  const high = new Float32Array(3 * n).fill(-Infinity);
  const widen = (cell, vertex) => {
    for (let k = 0; k < d; ++k) {
      const at = points[vertex * d + k];
      if (at < low[3 * cell + k]) low[3 * cell + k] = at;
      if (at > high[3 * cell + k]) high[3 * cell + k] = at;
    }
  };
  let corner = 0;
  for (let face = 0; face < sizes.length; ++face)
    for (const end = corner + sizes[face]; corner < end; ++corner) {
      widen(inner[face], corners[corner]);
      if (outer && outer[face] >= 0) widen(outer[face], corners[corner]);
    }
  const centres = new Float32Array(4 * n); // x, y, z, radius; a radius below 0 where there is no cell
  for (let cell = 0; cell < n; ++cell) {
    centres[4 * cell + 3] = -1;
    if (!(low[3 * cell] <= high[3 * cell])) continue;
    let squared = 0;
    for (let k = 0; k < d; ++k) {
      centres[4 * cell + k] = (low[3 * cell + k] + high[3 * cell + k]) / 2;
      squared += (high[3 * cell + k] - low[3 * cell + k]) ** 2;
    }
    centres[4 * cell + 3] = Math.sqrt(squared) / 2;
  }
  return centres;
}

function bounds(points, dimension) {
  const low = [0, 0, 0];
  const high = [0, 0, 0];
  let radius = 0;
  for (let at = 0; at < points.length; at += dimension) {
    let squared = 0;
    for (let k = 0; k < dimension; ++k) {
      const value = points[at + k];
      if (at === 0 || value < low[k]) low[k] = value;
      if (at === 0 || value > high[k]) high[k] = value;
      squared += value * value;
    }
    radius = Math.max(radius, squared);
  }
  return { low, high, radius: Math.sqrt(radius) || 1 };
}

/** Triangles, faces, bounds and balls of a decoded diagram. */
export function makeModel(diagram) {
  const { points, corners, sizes, inner, outer, normals, position, status } = diagram.arrays;
  const d = diagram.dimension;
  const solid = diagram.kind === "volume";
  const { offset, scale } = diagram.frame;
  const seeds = new Float32Array(3 * diagram.seeds);
  for (let i = 0; i < diagram.seeds; ++i)
    for (let k = 0; k < d; ++k) seeds[3 * i + k] = (position[d * i + k] - offset[k]) / scale;
  const each = diagram.check.domain_measure / Math.max(1, diagram.check.cells);
  return {
    cellSize: (solid ? Math.cbrt(each) : Math.sqrt(each)) / scale, // the width of a mean cell
    flat: diagram.kind === "polygon",
    solid,
    dimension: d,
    cells: diagram.seeds,
    ...bounds(points, d),
    points,
    normals,
    inner,
    outer,
    status,
    seeds,
    centres: balls(diagram),
    triangles: triangulate({ points, dimension: d, sizes, corners, mayBeHollow: solid }),
  };
}

/** A coordinate of the picture as the diagram has it. */
export function toUser(diagram, value, axis) {
  return diagram.frame.offset[axis] + diagram.frame.scale * value;
}
