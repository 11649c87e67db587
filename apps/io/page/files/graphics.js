// Programs, tables and buffers of WebGL 2.

const WIDTH = 2048; // of tables; every device has textures of that size

function compile(gl, kind, source) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
    throw new Error(`a program of the page was refused: ${gl.getShaderInfoLog(shader)}`);
  return shader;
}

/** A program with setters for its uniforms: program.set({u_size: 3}). */
export class Program {
  constructor(gl, vertex, fragment) {
    this.gl = gl;
    this.id = gl.createProgram();
    gl.attachShader(this.id, compile(gl, gl.VERTEX_SHADER, vertex));
    gl.attachShader(this.id, compile(gl, gl.FRAGMENT_SHADER, fragment));
    gl.linkProgram(this.id);
    if (!gl.getProgramParameter(this.id, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(`a program of the page was refused: ${gl.getProgramInfoLog(this.id)}`);
    this.uniforms = new Map();
    const count = gl.getProgramParameter(this.id, gl.ACTIVE_UNIFORMS) ?? 0;
    for (let k = 0; k < count; ++k) {
      const { name, type } = gl.getActiveUniform(this.id, k);
      this.uniforms.set(name, { type, place: gl.getUniformLocation(this.id, name) });
    }
  }

  /** Makes the program current and sets uniforms; textures by their object. Those it does not use are left out. */
  use(values) {
    const { gl } = this;
    gl.useProgram(this.id);
    let unit = 0;
    for (const [name, { type, place }] of this.uniforms) {
      const value = values[name];
      if (value === undefined) throw new Error(`the uniform ${name} has no value`);
      if (type === gl.FLOAT) gl.uniform1f(place, value);
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(place, value);
      else if (type === gl.FLOAT_VEC4) gl.uniform4fv(place, value);
      else if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(place, false, value);
      else if (type === gl.UNSIGNED_INT) gl.uniform1ui(place, value);
      else if (type === gl.INT || type === gl.BOOL) gl.uniform1i(place, value);
      else {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, value);
        gl.uniform1i(place, unit++);
      }
    }
  }
}

/** Formats of tables: [internal format, format, type, numbers an entry]. */
function format(gl, kind) {
  return {
    uint: [gl.R32UI, gl.RED_INTEGER, gl.UNSIGNED_INT, 1],
    uint2: [gl.RG32UI, gl.RG_INTEGER, gl.UNSIGNED_INT, 2],
    uint4: [gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, 4],
    float2: [gl.RG32F, gl.RG, gl.FLOAT, 2],
    float3: [gl.RGB32F, gl.RGB, gl.FLOAT, 3],
    float4: [gl.RGBA32F, gl.RGBA, gl.FLOAT, 4],
    colour: [gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, 4],
    normal: [gl.RGB8_SNORM, gl.RGB, gl.BYTE, 3],
  }[kind];
}

function plainTexture(gl) {
  const texture = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  return texture;
}

/** Numbers in a texture, which programs read by index. */
export class Table {
  constructor(gl, kind, entries) {
    this.gl = gl;
    [this.internal, this.format, this.type, this.size] = format(gl, kind);
    this.rows = Math.max(1, Math.ceil(entries / WIDTH));
    this.texture = plainTexture(gl);
    gl.texStorage2D(gl.TEXTURE_2D, 1, this.internal, WIDTH, this.rows);
  }

  /** Enters the first `entries`. */
  fill(values, entries = values.length / this.size) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    const rows = Math.floor(entries / WIDTH);
    const rest = entries - rows * WIDTH;
    if (rows > 0) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDTH, rows, this.format, this.type, values, 0);
    if (rest > 0)
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, rows, rest, 1, this.format, this.type, values, rows * WIDTH * this.size);
    return this;
  }
}

export function table(gl, kind, values) {
  const made = new Table(gl, kind, values.length / format(gl, kind)[3]);
  return made.fill(values);
}

/** The buffers of one pass: which cell, and its normal. */
export class Buffers {
  constructor(gl) {
    this.gl = gl;
    this.width = this.height = 0;
  }

  resize(width, height) {
    if (width === this.width && height === this.height) return;
    const { gl } = this;
    this.free();
    [this.width, this.height] = [width, height];
    this.cells = plainTexture(gl);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.R32UI, width, height);
    this.normals = plainTexture(gl);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, width, height);
    this.depth = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    this.frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.cells, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT1, gl.TEXTURE_2D, this.normals, 0);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
    gl.drawBuffers([gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1]);
  }

  free() {
    const { gl } = this;
    gl.deleteFramebuffer(this.frame ?? null);
    gl.deleteRenderbuffer(this.depth ?? null);
    gl.deleteTexture(this.cells ?? null);
    gl.deleteTexture(this.normals ?? null);
  }

  clear() {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.viewport(0, 0, this.width, this.height);
    gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
    gl.clearBufferfv(gl.COLOR, 1, [0.5, 0.5, 1, 0]);
    gl.clearBufferfv(gl.DEPTH, 0, [1]);
  }

  /** What was drawn at a place, from the bottom left. */
  cellAt(x, y) {
    const { gl } = this;
    if (!(x >= 0 && y >= 0 && x < this.width && y < this.height)) return 0;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.readBuffer(gl.COLOR_ATTACHMENT0);
    const found = new Uint32Array(4);
    gl.readPixels(x, y, 1, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, found);
    return found[0];
  }
}
