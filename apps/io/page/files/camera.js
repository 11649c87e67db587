// Where the scene is seen from. A flat diagram is seen from above and only moved and scaled; others turn about an
// upright axis, as on a turntable, so that up stays up.
import { add, clamp, cross, eyeMatrix, orthographic, perspective, product, scaled, unit } from "./vectors.js";

const START = { yaw: -0.927, pitch: 0.48 }; // the view of the tool's pictures
const VIEW = 0.55; // height of the picture at depth 1: an angle of 31 degrees
const MARGIN = 1.06;

export class Camera {
  /** @param model flat, radius and bounds of the scene, about the origin */
  constructor(model) {
    this.flat = model.flat;
    this.radius = model.radius;
    this.low = model.low;
    this.high = model.high;
    this.aspect = 1;
    this.reset();
  }

  reset() {
    Object.assign(this, START);
    this.target = scaled(add(this.low, this.high), 0.5);
    this.height = this.wholeHeight(); // of the picture, where the target is
  }

  /** The height at which all of the scene is in the picture. */
  wholeHeight() {
    if (!this.flat) return 2 * this.radius * MARGIN * Math.max(1, 1 / this.aspect);
    const width = this.high[0] - this.low[0];
    const height = this.high[1] - this.low[1];
    return MARGIN * Math.max(height, width / this.aspect, 1e-6);
  }

  /** A changed window keeps a whole scene whole. */
  setAspect(aspect) {
    const zoom = this.height / this.wholeHeight();
    this.aspect = aspect;
    this.height = zoom * this.wholeHeight();
  }

  axes() {
    if (this.flat) return { right: [1, 0, 0], up: [0, 1, 0], back: [0, 0, 1] };
    const level = Math.cos(this.pitch);
    const back = [level * Math.cos(this.yaw), level * Math.sin(this.yaw), Math.sin(this.pitch)];
    const right = unit(cross([0, 0, 1], back));
    return { right, up: cross(back, right), back };
  }

  /** @param apart how far cells are moved apart */
  matrices(apart) {
    const { right, up, back } = this.axes();
    const reach = this.radius * (1 + apart) + Math.hypot(...this.target);
    if (this.flat) {
      const eye = eyeMatrix(right, up, back, this.target);
      return { eye, all: product(orthographic(this.height, this.aspect, -2 * reach, 2 * reach), eye) };
    }
    const depth = this.height / VIEW;
    const eye = eyeMatrix(right, up, back, add(this.target, scaled(back, depth)));
    const near = Math.max(depth - reach, 0.01 * depth);
    return { eye, all: product(perspective(VIEW, this.aspect, near, depth + reach), eye) };
  }

  turn(dx, dy) {
    this.yaw -= dx;
    this.pitch = clamp(this.pitch - dy, -1.57, 1.57);
  }

  /** Moves the scene by parts of the picture's height. */
  move(dx, dy) {
    const { right, up } = this.axes();
    this.target = add(this.target, add(scaled(right, -dx * this.height), scaled(up, -dy * this.height)));
    const far = 2 * this.radius;
    this.target = this.target.map((value) => clamp(value, -far, far));
  }

  /** Shows `factor` times as much, and keeps the point at (x, y) in place: parts of the height from the middle. */
  zoom(factor, x = 0, y = 0) {
    const whole = this.wholeHeight();
    const height = clamp(this.height * factor, whole * (this.flat ? 1e-5 : 1e-3), whole * 8);
    const change = 1 - height / this.height;
    this.move(-x * change, -y * change);
    this.height = height;
  }

  /** Brings a point to the middle of the picture. */
  lookAt(point) {
    this.target = [...point];
  }
}
