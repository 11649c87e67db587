// What a plane leaves of the cells, and which triangles can be seen then.

/** No cell, one that is whole, one that the plane cuts. */
export const GONE = 0;
export const WHOLE = 1;
export const CUT = 2;

/**
 * How each cell stands to the plane normal . x <= distance.
 * @param whole  keep or remove cells as wholes, by their middles
 */
export function statesOf(model, plane, shown, whole) {
  const { centres, cells } = model;
  const states = new Uint8Array(cells);
  for (let cell = 0; cell < cells; ++cell) {
    const radius = centres[4 * cell + 3];
    if (radius < 0 || !shown[cell]) continue;
    if (!plane) {
      states[cell] = WHOLE;
      continue;
    }
    const [x, y, z] = plane.normal;
    const beyond = x * centres[4 * cell] + y * centres[4 * cell + 1] + z * centres[4 * cell + 2] - plane.distance;
    if (whole) states[cell] = beyond > 0 ? GONE : WHOLE;
    else states[cell] = beyond > radius ? GONE : beyond <= -radius ? WHOLE : CUT;
  }
  return states;
}

/**
 * Triangles that may be in sight. A wall between two whole cells is not, unless the cells are moved apart.
 * @param list  receives the triangles, large enough for all of them @returns how many
 */
export function visibleTriangles(model, states, apart, list) {
  const { inner, outer, triangles } = model;
  let count = 0;
  for (let face = 0; face < inner.length; ++face) {
    const a = states[inner[face]];
    const b = outer && outer[face] >= 0 ? states[outer[face]] : GONE;
    if (a === GONE && b === GONE) continue;
    if (!apart && a === WHOLE && b === WHOLE) continue;
    for (let t = triangles.first[face]; t < triangles.first[face + 1]; ++t) list[count++] = t;
  }
  return count;
}

/** The triangles of one cell. */
export function trianglesOf(model, cell) {
  const { inner, outer, triangles } = model;
  const found = [];
  for (let face = 0; face < inner.length; ++face) {
    if (inner[face] !== cell && !(outer && outer[face] === cell)) continue;
    for (let t = triangles.first[face]; t < triangles.first[face + 1]; ++t) found.push(t);
  }
  return Uint32Array.from(found);
}
