// Draws a model. The picture is fine, with four samples a pixel, when nothing moves.
import { Buffers, Program, Table, table } from "./graphics.js";
import { CELL_BITS, PROGRAMS } from "./shaders.js";
import { GONE, statesOf, trianglesOf, visibleTriangles } from "./slice.js";

const NO_PLANE = [0, 0, 0, 0];
const MOST_SAMPLES = 12e6; // of a picture: beyond, one a pixel

/** The tables of a model that stay the same. */
function tablesOf(gl, model) {
  const faces = new Uint32Array(2 * model.inner.length);
  for (let face = 0; face < model.inner.length; ++face) {
    faces[2 * face] = model.inner[face] + 1;
    if (model.outer) faces[2 * face + 1] = model.outer[face] + 1;
  }
  return {
    u_triangles: table(gl, "uint4", model.triangles.records).texture,
    u_faces: table(gl, "uint2", faces).texture,
    u_points: table(gl, model.dimension === 3 ? "float3" : "float2", model.points).texture,
    u_centres: table(gl, "float4", model.centres).texture,
    u_normals: table(gl, "normal", model.normals ?? new Int8Array(3)).texture,
  };
}

export class Renderer {
  constructor(gl, model) {
    this.gl = gl;
    this.model = model;
    this.programs = Object.fromEntries(
      Object.entries(PROGRAMS).map(([name, sources]) => [name, new Program(gl, ...sources)]),
    );
    this.tables = tablesOf(gl, model);
    this.colours = new Table(gl, "colour", model.cells);
    this.rgba = new Uint8Array(4 * model.cells);
    this.list = new Uint32Array(model.triangles.count);
    this.listTable = new Table(gl, "uint", model.triangles.count);
    this.chosenTable = new Table(gl, "uint", 1);
    this.buffers = new Buffers(gl);
    this.empty = gl.createVertexArray();
    this.seeds = this.seedArray();
    this.chosen = -1;
  }

  seedArray() {
    const { gl, model } = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const enter = (place, size, values) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    };
    enter(0, 3, model.seeds);
    enter(1, 1, Float32Array.from(model.status));
    return array;
  }

  /** @param rgb three bytes a cell */
  setColours(rgb) {
    for (let cell = 0; cell < this.model.cells; ++cell)
      for (let k = 0; k < 3; ++k) this.rgba[4 * cell + k] = rgb[3 * cell + k];
    this.colours.fill(this.rgba);
  }

  /**
   * What is shown.
   * @param plane {normal, distance} or null @param shown per cell @param whole  cells stay whole at the plane
   * @param apart  how far cells are moved from the middle
   */
  setShape({ plane, shown, whole, apart }) {
    const states = statesOf(this.model, plane, shown, whole);
    this.plane = plane && !whole ? [...plane.normal, plane.distance] : NO_PLANE;
    this.apart = apart;
    this.triangles = visibleTriangles(this.model, states, apart > 0, this.list);
    this.listTable.fill(this.list, this.triangles);
    for (let cell = 0; cell < this.model.cells; ++cell) this.rgba[4 * cell + 3] = states[cell] === GONE ? 0 : 255;
    this.colours.fill(this.rgba);
  }

  /** @param cell a number, or -1 */
  choose(cell) {
    this.chosen = cell;
    const own = cell < 0 ? new Uint32Array() : trianglesOf(this.model, cell);
    this.chosenTriangles = own.length;
    this.gl.deleteTexture(this.chosenTable.texture);
    this.chosenTable = table(this.gl, "uint", own);
  }

  /** @param look camera matrices, and ink, mark (colours), lines, dots (their size, 0 for none), fine */
  draw({ eye, all, ink, mark, lines, dots, fine }) {
    const { gl, model, programs } = this;
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    this.fine = fine && 4 * width * height <= MOST_SAMPLES ? 2 : 1;
    this.buffers.resize(this.fine * width, this.fine * height);
    const common = {
      ...this.tables,
      u_list: this.listTable.texture,
      u_colours: this.colours.texture,
      u_all: all,
      u_eye: eye,
      u_plane: this.plane,
      u_apart: this.apart,
      u_smooth: Boolean(model.normals),
      u_solid: model.solid,
      u_mark: mark,
      u_ink: ink,
    };
    this.buffers.clear();
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.bindVertexArray(this.empty);
    programs.cells.use(common);
    gl.drawArraysInstanced(gl.TRIANGLES, 0, 3 * this.triangles, this.apart > 0 && model.solid ? 2 : 1);
    if (dots > 0) {
      gl.bindVertexArray(this.seeds);
      programs.seeds.use({ ...common, u_size: dots * this.fine });
      gl.drawArrays(gl.POINTS, 0, model.cells);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(this.empty);
    programs.picture.use({
      ...common,
      u_cells: this.buffers.cells,
      u_normals: this.buffers.normals,
      u_fine: this.fine,
      u_lines: lines,
      u_lit: !model.flat,
      u_chosen: this.chosen + 1,
    });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    if (this.chosen >= 0) this.drawChosen(common);
  }

  drawChosen(common) {
    const { gl, model, programs } = this;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (model.solid && this.chosenTriangles > 0) {
      programs.through.use({ ...common, u_list: this.chosenTable.texture, u_plane: NO_PLANE, u_apart: 0 });
      if (this.apart === 0) gl.drawArraysInstanced(gl.TRIANGLES, 0, 3 * this.chosenTriangles, 1);
    }
    let at = [...model.seeds.subarray(3 * this.chosen, 3 * this.chosen + 3)];
    if (this.apart > 0 && model.centres[4 * this.chosen + 3] >= 0)
      at = at.map((value, k) => value + this.apart * model.centres[4 * this.chosen + k]);
    programs.spot.use({ ...common, u_at: at, u_size: 11 * (window.devicePixelRatio || 1) });
    gl.drawArrays(gl.POINTS, 0, 1);
  }

  /** The cell or seed at a pixel of the canvas, from the top left; -1 for none. */
  pick(x, y) {
    const drawn = this.buffers.cellAt(
      Math.floor(this.fine * (x + 0.5)),
      this.buffers.height - 1 - Math.floor(this.fine * (y + 0.5)),
    );
    return (drawn & ((1 << CELL_BITS) - 1)) - 1;
  }
}
