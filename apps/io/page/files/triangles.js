// Faces as triangles. Most are convex; a wall that the domain's boundary cuts may not be.
import { cross, dot, subtract, unit } from "./vectors.js";

const FLAT = 1e-7; // sines below this are those of coordinates rounded to 24 bits

function point(points, dimension, index) {
  const at = index * dimension;
  return [points[at], points[at + 1], dimension === 3 ? points[at + 2] : 0];
}

/** Twice the area of a polygon, as a vector at right angles to it. */
function areaVector(corners) {
  let sum = [0, 0, 0];
  for (let k = 1; k + 1 < corners.length; ++k) {
    const part = cross(subtract(corners[k], corners[0]), subtract(corners[k + 1], corners[0]));
    sum = [sum[0] + part[0], sum[1] + part[1], sum[2] + part[2]];
  }
  return sum;
}

/** The sine with which a polygon of this normal turns left at b. */
function turn(normal, a, b, c) {
  return dot(normal, cross(unit(subtract(b, a)), unit(subtract(c, b))));
}

function isConvex(normal, corners) {
  const n = corners.length;
  return corners.every((b, k) => turn(normal, corners[(k + n - 1) % n], b, corners[(k + 1) % n]) > -FLAT);
}

function isInside(normal, [a, b, c], p) {
  const side = (from, to) => dot(normal, cross(subtract(to, from), subtract(p, from)));
  return side(a, b) > 0 && side(b, c) > 0 && side(c, a) > 0;
}

/** Cuts corners off a polygon, one triangle at a time. @returns triples of places in `corners` */
export function cutEars(corners) {
  const normal = unit(areaVector(corners));
  const left = corners.map((_, k) => k);
  const triangles = [];
  while (left.length > 3) {
    const n = left.length;
    let best = -1;
    for (let k = 0; k < n && best < 0; ++k) {
      const ear = [left[(k + n - 1) % n], left[k], left[(k + 1) % n]];
      const shape = ear.map((e) => corners[e]);
      if (turn(normal, ...shape) <= FLAT) continue;
      if (!left.some((e) => !ear.includes(e) && isInside(normal, shape, corners[e]))) best = k;
    }
    if (best < 0) best = 1; // only slivers are left
    triangles.push([left[(best + n - 1) % n], left[best], left[(best + 1) % n]]);
    left.splice(best, 1);
  }
  triangles.push(left);
  return triangles;
}

function fan(count) {
  return Array.from({ length: count - 2 }, (_, k) => [0, k + 1, k + 2]);
}

const FANS = Array.from({ length: 40 }, (_, k) => (k < 3 ? [] : fan(k)));

/**
 * @param faces sizes and corners of faces, indices of points
 * @returns `records`: four numbers a triangle, its points and its face; `first`: of each face its first triangle
 */
export function triangulate({ points, dimension, sizes, corners, mayBeHollow }) {
  const count = sizes.reduce((sum, size) => sum + Math.max(size - 2, 0), 0);
  const records = new Uint32Array(4 * count);
  const first = new Uint32Array(sizes.length + 1);
  let triangle = 0;
  let begin = 0;
  for (let face = 0; face < sizes.length; ++face) {
    const size = sizes[face];
    let parts = size < FANS.length ? FANS[size] : fan(size);
    if (mayBeHollow && size > 3) {
      const shape = Array.from({ length: size }, (_, k) => point(points, dimension, corners[begin + k]));
      if (!isConvex(unit(areaVector(shape)), shape)) parts = cutEars(shape);
    }
    for (const part of parts) {
      for (let k = 0; k < 3; ++k) records[4 * triangle + k] = corners[begin + part[k]];
      records[4 * triangle + 3] = face;
      ++triangle;
    }
    begin += size;
    first[face + 1] = triangle;
  }
  return { records, first, count };
}
