// The page: reads the diagram, draws it, and passes on what the user does.
import { Camera } from "./camera.js";
import { readDiagram } from "./decode.js";
import { listen } from "./gestures.js";
import { makeModel } from "./model.js";
import { Panel, showFailure } from "./panel.js";
import { Renderer } from "./renderer.js";
import { measuresOf } from "./rows.js";
import { colourClasses, colourNumbers } from "./scales.js";
import { clamp, scaled } from "./vectors.js";

const STILL = 150; // milliseconds without a change until the picture is drawn finely
const MOST_DOTS = 20000; // more seeds than these cannot be told apart
const DEPTHS = 1000; // steps of the slider

const canvas = document.getElementById("canvas");
const root = document.documentElement;

class View {
  constructor(diagram) {
    this.diagram = diagram;
    this.model = makeModel(diagram);
    this.camera = new Camera(this.model);
    this.chosen = -1;
    this.state = {
      colour: measuresOf(diagram).findIndex(({ name }) => name === diagram.colour),
      scale: "even",
      from: -Infinity,
      to: Infinity,
      axis: "none",
      depth: DEPTHS / 2,
      side: 1,
      distance: 0,
      whole: false,
      apart: 0,
      dots: this.model.flat && diagram.seeds <= MOST_DOTS,
    };
    this.panel = new Panel(diagram, this.model, { change: (part) => this.change(part), choose: (cell) => this.find(cell) });
    this.start();
    listen(canvas, this.model.flat, {
      turn: (dx, dy) => this.moved(() => this.camera.turn(3.5 * dx, 3.5 * dy)),
      move: (dx, dy) => this.moved(() => this.camera.move(dx, dy)),
      zoom: (factor, x, y) => this.moved(() => this.camera.zoom(factor, x, y)),
      pick: (x, y) => this.pick(x, y),
      key: (name, shift) => this.key(name, shift),
    });
    new ResizeObserver(() => this.resize()).observe(canvas);
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.start());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    document.getElementById("theme").addEventListener("click", () => this.changeTheme());
    document.getElementById("reset").addEventListener("click", () => this.moved(() => this.camera.reset()));
    this.panel.showRow(-1);
  }

  /** Makes what the graphics card needs, also after it lost everything. */
  start() {
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("This page needs WebGL 2, which this browser does not have or has switched off.");
    this.renderer = new Renderer(gl, this.model);
    this.colour();
    this.shape();
    this.renderer.choose(this.chosen);
    this.resize();
  }

  resize() {
    const fine = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * fine));
    const height = Math.max(1, Math.round(canvas.clientHeight * fine));
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    this.camera.setAspect(width / height);
    this.draw();
  }

  colour() {
    const { cell_colours: own, status } = this.diagram.arrays;
    const isCell = (cell) => status[cell] === 0;
    const by = this.panel.measures[this.state.colour];
    let result = { colours: own, legend: { kind: "cells" } };
    if (by?.classes) result = colourClasses(by.classes, by.names, isCell, this.diagram.palette);
    else if (by) result = colourNumbers(by.numbers, this.state.scale, isCell, this.diagram.scale);
    const { from, to } = this.state;
    const all = from === -Infinity && to === Infinity;
    const isWithin = (cell) => all || !by?.numbers || (by.numbers[cell] >= from && by.numbers[cell] <= to);
    this.shown = Uint8Array.from(status, (_, cell) => (isCell(cell) && isWithin(cell) ? 1 : 0));
    this.renderer.setColours(result.colours);
    this.panel.showLegend(result.legend);
  }

  /** The plane of the slice, and where it lies on its axis. */
  plane() {
    const { axis, depth, side } = this.state;
    if (axis === "none") return null;
    const k = "xyz".indexOf(axis);
    const { low, high, radius } = this.model;
    const normal = k < 0 ? this.direction : [0, 1, 2].map((other) => (other === k ? 1 : 0));
    const [from, to] = k < 0 ? [-radius, radius] : [low[k], high[k]];
    this.state.distance = from + (depth / DEPTHS) * (to - from);
    return { normal: scaled(normal, side), distance: side * this.state.distance };
  }

  shape() {
    const { whole, apart } = this.state;
    this.renderer.setShape({ plane: this.plane(), shown: this.shown, whole, apart });
    this.panel.show(this.state);
  }

  change(part) {
    if (part.flip) this.state.side = -this.state.side;
    if (part.axis) this.sliceAlong(part.axis);
    for (const name of ["colour", "scale", "from", "to", "depth", "whole", "apart", "dots"])
      if (name in part) this.state[name] = part[name];
    if ("colour" in part) Object.assign(this.state, { scale: "even", from: -Infinity, to: Infinity });
    if (["colour", "scale", "from", "to"].some((name) => name in part)) this.colour();
    this.shape();
    this.draw();
  }

  /** The part towards the camera is taken away. */
  sliceAlong(axis) {
    const { back } = this.camera.axes();
    const k = "xyz".indexOf(axis);
    this.state.axis = axis;
    this.state.depth = DEPTHS / 2;
    this.state.side = k >= 0 && back[k] < 0 ? -1 : 1;
    this.direction = back;
  }

  choose(cell) {
    this.chosen = cell;
    this.renderer.choose(cell);
    this.panel.showRow(cell);
    canvas.dataset.chosen = cell;
    this.draw();
  }

  pick(x, y) {
    if (!this.renderer.fine) return;
    const scale = canvas.width / canvas.clientWidth;
    this.choose(this.renderer.pick(x * scale, y * scale));
  }

  /** Chooses a seed by its number, and brings it into a flat picture. */
  find(seed) {
    const at = [...this.model.seeds.subarray(3 * seed, 3 * seed + 3)];
    const { target, height, aspect } = this.camera;
    const away = Math.max(Math.abs(at[0] - target[0]) / aspect, Math.abs(at[1] - target[1]));
    if (this.model.flat && away > height / 2) this.camera.lookAt(at);
    this.choose(seed);
  }

  moved(action) {
    action();
    this.draw();
  }

  key(name, shift) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const axis = { x: "x", y: "y", z: "z", v: "view" }[name];
    const { state, camera, model } = this;
    if (name in steps) {
      const [dx, dy] = scaled([...steps[name], 0], 0.05);
      this.moved(() => (model.flat || shift ? camera.move(dx, dy) : camera.turn(2 * dx, 2 * dy)));
    } else if (name === "+" || name === "=") this.moved(() => camera.zoom(0.85));
    else if (name === "-") this.moved(() => camera.zoom(1 / 0.85));
    else if (name === "0" || name === "Home") this.moved(() => camera.reset());
    else if (name === "Enter") this.pick(canvas.clientWidth / 2, canvas.clientHeight / 2);
    else if (name === "Escape") this.choose(-1);
    else if (name === "n" || name === "p") {
      const count = this.diagram.seeds;
      if (count > 0) this.find((this.chosen + (name === "n" ? 1 : this.chosen < 0 ? 0 : -1) + count) % count);
    } else if (axis && !model.flat) this.change({ axis: state.axis === axis && axis !== "view" ? "none" : axis });
    else if ((name === "[" || name === "]") && state.axis !== "none")
      this.change({ depth: clamp(state.depth + (name === "]" ? 10 : -10), 0, DEPTHS) });
    else return false;
    return true;
  }

  changeTheme() {
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const now = root.dataset.theme ?? (dark ? "dark" : "light");
    root.dataset.theme = now === "dark" ? "light" : "dark";
    this.draw();
  }

  /** Draws at the next frame, and finely when nothing has changed for a while. */
  draw() {
    canvas.dataset.drawn = "";
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      cancelAnimationFrame(this.frame); // which may come later, where frames are slow
      this.frame = undefined;
      this.render(true);
    }, STILL);
    this.frame ??= requestAnimationFrame(() => {
      this.frame = undefined;
      this.render(false);
    });
  }

  render(fine) {
    if (this.renderer.gl.isContextLost()) return;
    const { camera, model, state } = this;
    const pixels = (model.cellSize / camera.height) * canvas.height;
    const { eye, all } = camera.matrices(state.apart);
    const style = getComputedStyle(root);
    const colour = (name) => {
      const text = style.getPropertyValue(name).trim();
      return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16) / 255);
    };
    this.renderer.draw({
      eye,
      all,
      ink: colour("--line"),
      mark: colour("--mark"),
      lines: clamp((pixels - 2.5) / 9, 0, 1),
      dots: state.dots ? clamp(0.09 * pixels, 2.5, 7 * (window.devicePixelRatio || 1)) : 0,
      fine,
    });
    canvas.dataset.matrix = all.join(" ");
    canvas.dataset.drawn = fine ? "fine" : "coarse";
  }
}

readDiagram()
  .then((diagram) => new View(diagram))
  .then(() => (root.dataset.state = "ready"))
  .catch((error) => {
    root.dataset.state = "failed";
    showFailure(error.message);
  });
