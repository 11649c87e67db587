// The programs of the graphics card. Cells are drawn into two buffers, which cell and which way its surface looks,
// and a second pass makes the picture of them: so lines between cells need no lines, and the cell under a finger is
// read from the first buffer.

const HEAD = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
const int WIDTH = 2048;  // of the tables of numbers that textures are
ivec2 place(uint index) { return ivec2(int(index) % WIDTH, int(index) / WIDTH); }
`;

/** Cells in the buffer are numbered from 1; the top bits say what was drawn. */
export const CELL_BITS = 28;

const CORNER = `${HEAD}
uniform usampler2D u_list, u_triangles, u_faces;
uniform sampler2D u_points, u_centres, u_normals;
uniform mat4 u_all;
uniform vec4 u_plane;  // cells are cut off where plane.xyz . x > plane.w
uniform float u_apart;
uniform bool u_smooth;
flat out uvec2 v_cells;  // behind the face, and in front of it; 0 for none
out vec3 v_at, v_normal;
out float v_beyond;

void main() {
  uvec4 triangle = texelFetch(u_triangles, place(texelFetch(u_list, place(uint(gl_VertexID / 3)), 0).r), 0);
  uint corner = triangle[gl_VertexID % 3];
  v_cells = texelFetch(u_faces, place(triangle.w), 0).xy;
  vec3 at = texelFetch(u_points, place(corner), 0).xyz;
  v_beyond = dot(u_plane.xyz, at) - u_plane.w;
  v_normal = u_smooth ? texelFetch(u_normals, place(corner), 0).xyz : vec3(0);
  if (u_apart > 0.0) {  // each cell has its own copy of the wall
    v_cells = gl_InstanceID == 0 ? uvec2(v_cells.x, 0u) : uvec2(0u, v_cells.y);
    uint own = max(v_cells.x, v_cells.y);
    if (own > 0u) at += u_apart * texelFetch(u_centres, place(own - 1u), 0).xyz;
  }
  v_at = at;
  gl_Position = v_cells == uvec2(0) ? vec4(2, 2, 2, 1) : u_all * vec4(at, 1);
}
`;

const SURFACE = `${HEAD}
uniform sampler2D u_colours;
uniform mat4 u_eye;
uniform vec4 u_plane;
uniform bool u_solid, u_smooth;
flat in uvec2 v_cells;
in vec3 v_at, v_normal;
in float v_beyond;
layout(location = 0) out uint o_cell;
layout(location = 1) out vec4 o_normal;

bool is_shown(uint cell) { return cell > 0u && texelFetch(u_colours, place(cell - 1u), 0).a > 0.5; }

void main() {
  if (v_beyond > 0.0) discard;
  vec3 normal = normalize(cross(dFdx(v_at), dFdy(v_at)));  // towards the camera
  if (u_smooth && dot(v_normal, v_normal) > 0.1) normal = normalize(v_normal) * (dot(v_normal, normal) < 0.0 ? -1.0 : 1.0);
  uint near = gl_FrontFacing ? v_cells.y : v_cells.x;
  uint far = gl_FrontFacing ? v_cells.x : v_cells.y;
  if (!u_solid) {
    near = 0u;
    far = v_cells.x;
  }
  // A face seen from within a cell: the plane has opened that cell, and what shows is the cut.
  bool opened = is_shown(near);
  if (!opened && !is_shown(far)) discard;
  o_cell = opened ? near : far;
  if (opened && dot(u_plane.xyz, u_plane.xyz) > 0.0) normal = u_plane.xyz;
  o_normal = vec4(0.5 + 0.5 * (mat3(u_eye) * normal), 1);
}
`;

const SEED = `${HEAD}
uniform mat4 u_all;
uniform vec4 u_plane;
uniform float u_apart, u_size;
uniform sampler2D u_centres, u_colours;
layout(location = 0) in vec3 a_at;
layout(location = 1) in float a_status;
flat out uint v_cell;

void main() {
  vec4 centre = texelFetch(u_centres, place(uint(gl_VertexID)), 0);
  vec3 at = centre.w < 0.0 ? a_at : a_at + u_apart * centre.xyz;
  bool shown = centre.w < 0.0 || texelFetch(u_colours, place(uint(gl_VertexID)), 0).a > 0.5;
  shown = shown && dot(u_plane.xyz, a_at) <= u_plane.w;
  gl_Position = shown ? u_all * vec4(at, 1) : vec4(2, 2, 2, 1);
  gl_Position.z -= 1e-4 * gl_Position.w;  // before the surface that it lies in
  gl_PointSize = a_status > 0.5 ? 1.8 * u_size : u_size;
  v_cell = uint(gl_VertexID + 1) | (uint(a_status) + 1u) << ${CELL_BITS};
}
`;

const DOT = `${HEAD}
flat in uint v_cell;
layout(location = 0) out uint o_cell;
layout(location = 1) out vec4 o_normal;

void main() {
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  uint status = v_cell >> ${CELL_BITS};
  if (status == 3u ? min(abs(at.x - at.y), abs(at.x + at.y)) > 0.3 : length(at) > 1.0) discard;  // a cross
  if (status == 2u && length(at) < 0.6) discard;  // a ring
  o_cell = v_cell;
  o_normal = vec4(0.5, 0.5, 1, 1);
}
`;

const WINDOW = `${HEAD}
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }
`;

const PICTURE = `${HEAD}
uniform usampler2D u_cells;
uniform sampler2D u_normals, u_colours;
uniform int u_fine;       // pixels of the buffers to one of the picture, across
uniform float u_lines;    // strength of the lines between cells, 0 to 1
uniform bool u_lit;
uniform uint u_chosen;    // numbered from 1; 0 for none
uniform vec3 u_ink, u_mark;
out vec4 o_colour;

const uint CELL = (1u << ${CELL_BITS}) - 1u;
ivec2 size;

uint cell_at(ivec2 p) { return texelFetch(u_cells, clamp(p, ivec2(0), size - 1), 0).r; }
vec3 normal_at(ivec2 p) { return 2.0 * texelFetch(u_normals, clamp(p, ivec2(0), size - 1), 0).xyz - 1.0; }

float brightness(uint cell) {
  return dot(texelFetch(u_colours, place(cell - 1u), 0).rgb, vec3(0.3, 0.59, 0.11));
}

bool is_beside_chosen(ivec2 p, uint here) {
  bool inside = here == u_chosen;
  for (int k = 0; k < 8; ++k) {
    ivec2 step = ivec2(k < 3 ? -1 : k < 5 ? 0 : 1, k == 0 || k == 3 || k == 5 ? -1 : k == 1 || k == 6 ? 0 : 1);
    uint other = cell_at(p + u_fine * step);
    if (other <= CELL && (other == u_chosen) != inside) return true;
  }
  return false;
}

vec4 shaded(ivec2 p) {
  uint drawn = cell_at(p);
  uint right = cell_at(p + ivec2(1, 0)), above = cell_at(p + ivec2(0, 1));
  uint left = cell_at(p - ivec2(1, 0)), below = cell_at(p - ivec2(0, 1));
  if (drawn == 0u && left != 0u && left == right) drawn = left;     // a gap of rounding between triangles
  if (drawn == 0u && below != 0u && below == above) drawn = below;
  uint cell = drawn & CELL;
  if (u_chosen > 0u && drawn <= CELL && is_beside_chosen(p, drawn)) return vec4(u_mark, 1);
  if (drawn == 0u) return vec4(0);
  vec3 colour = texelFetch(u_colours, place(cell - 1u), 0).rgb;
  if (drawn > CELL) return vec4(cell == u_chosen ? u_mark : u_ink, 1);
  vec3 normal = normal_at(p);
  if (u_lit) {
    float light = 0.62 + 0.3 * max(dot(normal, normalize(vec3(-0.35, 0.55, 0.75))), 0.0) + 0.12 * normal.z;
    colour *= light;
  }
  float line = 0.0;
  uint other = drawn;
  if (right != drawn && right <= CELL) other = right;
  if (above != drawn && above <= CELL) other = above;
  if (left == 0u || below == 0u) other = 0u;  // the outline on all sides
  if (u_fine > 1 && left != drawn && left <= CELL) other = left;
  if (u_fine > 1 && below != drawn && below <= CELL) other = below;
  if (other != drawn) line = 1.0;
  if (line == 0.0 && u_lit && (dot(normal, normal_at(p + ivec2(1, 0))) < 0.8 || dot(normal, normal_at(p + ivec2(0, 1))) < 0.8))
    line = 0.45;  // an edge of one cell
  bool dark = brightness(cell) < 0.2 && (other == 0u || brightness(other) < 0.2);  // where ink would not be seen
  colour = mix(colour, dark ? vec3(1) : u_ink, (dark ? 0.35 : 0.75) * line * u_lines);
  if (cell == u_chosen) colour = mix(colour, u_mark, 0.3);
  return vec4(colour, 1);
}

void main() {
  size = textureSize(u_cells, 0);
  vec4 sum = vec4(0);
  for (int y = 0; y < u_fine; ++y)
    for (int x = 0; x < u_fine; ++x) sum += shaded(u_fine * ivec2(gl_FragCoord.xy) + ivec2(x, y));
  o_colour = sum / float(u_fine * u_fine);
}
`;

const THROUGH = `${HEAD}
uniform vec3 u_mark;
in float v_beyond;
out vec4 o_colour;
void main() {
  if (v_beyond > 0.0) discard;
  o_colour = vec4(u_mark, 1) * 0.16;
}
`;

const SPOT = `${HEAD}
uniform mat4 u_all;
uniform vec3 u_at;
uniform float u_size;
void main() {
  gl_Position = u_all * vec4(u_at, 1);
  gl_PointSize = u_size;
}
`;

const SPOT_DOT = `${HEAD}
uniform vec3 u_mark;
out vec4 o_colour;
void main() {
  float far = length(2.0 * gl_PointCoord - 1.0);
  if (far > 1.0) discard;
  o_colour = far > 0.55 ? vec4(1) : vec4(u_mark, 1);
}
`;

/** Pairs of vertex and fragment programs. */
export const PROGRAMS = {
  cells: [CORNER, SURFACE],
  seeds: [SEED, DOT],
  picture: [WINDOW, PICTURE],
  through: [CORNER, THROUGH], // the chosen cell, through those before it
  spot: [SPOT, SPOT_DOT], // the seed of the chosen cell
};
