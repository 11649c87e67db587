// Vectors of three numbers and matrices of 4 x 4, column by column, as WebGL has them.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const unit = (a) => scaled(a, 1 / (Math.hypot(...a) || 1));
export const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

/** The matrix product a b. */
export function product(a, b) {
  const result = new Array(16).fill(0);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let k = 0; k < 4; ++k) result[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return result;
}

/** Moves a scene in front of a camera at `eye` with the axes right, up and back. */
export function eyeMatrix(right, up, back, eye) {
  return [
    right[0], up[0], back[0], 0,
    right[1], up[1], back[1], 0,
    right[2], up[2], back[2], 0,
    -dot(right, eye), -dot(up, eye), -dot(back, eye), 1,
  ];
}

/** Projects between the depths near and far. `height` is that of the picture at depth 1. */
export function perspective(height, aspect, near, far) {
  const y = 2 / height;
  return [y / aspect, 0, 0, 0, 0, y, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
}

export function orthographic(height, aspect, near, far) {
  const y = 2 / height;
  return [y / aspect, 0, 0, 0, 0, y, 0, 0, 0, 0, 2 / (near - far), 0, 0, 0, (far + near) / (near - far), 1];
}
