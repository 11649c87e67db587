// Colours of numbers and of classes.
import { clamp } from "./vectors.js";

/**
 * A path in OKLab (Ottosson 2020), whose distances are those of the eye: from dark blue over green to light yellow.
 * Lightness rises all the way, so that the order is seen with any colour vision and in grey.
 */
const PATH = [
  [0.27, 0.03, -0.12],
  [0.45, -0.04, -0.11],
  [0.62, -0.1, -0.03],
  [0.79, -0.1, 0.1],
  [0.95, -0.03, 0.14],
];

/** Muted hues that differ in lightness too (Tol's "muted" scheme), for the most frequent classes. */
const CLASSES = ["#332288", "#88ccee", "#44aa99", "#117733", "#ddcc77", "#cc6677", "#882255", "#999933", "#aa4499"];
export const NEUTRAL = [150, 154, 160]; // no value, or one of the other classes

function srgb([lightness, a, b]) {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  return linear.map((value) => {
    const c = clamp(value, 0, 1);
    return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
  });
}

/** `count` colours with equal distances along the path. */
export function evenScale(count) {
  const lengths = PATH.slice(1).map((to, k) => Math.hypot(...to.map((value, c) => value - PATH[k][c])));
  const total = lengths.reduce((sum, length) => sum + length, 0);
  return Array.from({ length: count }, (_, k) => {
    let left = (k / (count - 1)) * total;
    let part = 0;
    while (part + 1 < lengths.length && left > lengths[part]) left -= lengths[part++];
    const share = left / lengths[part];
    return srgb(PATH[part].map((from, c) => from + share * (PATH[part + 1][c] - from)));
  });
}

const SCALE = evenScale(256);

export function hex(colour) {
  return `#${colour.map((channel) => channel.toString(16).padStart(2, "0")).join("")}`;
}
const fromHex = (text) => [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16));

/** The text of a number with few digits. */
export function shortNumber(value) {
  if (!Number.isFinite(value)) return "–";
  const text = value.toPrecision(4);
  return String(Number(text)).length <= 9 ? String(Number(text)) : Number(text).toExponential();
}

/** Where values lie on the scale: a function to [0, 1], and the values at even places for the legend. */
function placement(values, kind) {
  const sorted = Float64Array.from(values.filter(Number.isFinite)).sort();
  const n = sorted.length;
  const low = sorted[0];
  const high = sorted[n - 1];
  const at = (share) => sorted[Math.round(share * (n - 1))];
  if (kind === "rank") {
    const place = (value) => {
      let begin = 0;
      let end = n;
      while (begin < end) {
        const middle = (begin + end) >> 1;
        if (sorted[middle] < value) begin = middle + 1;
        else end = middle;
      }
      return n > 1 ? begin / (n - 1) : 0.5;
    };
    return { n, place, ticks: [0, 0.25, 0.5, 0.75, 1].map(at) };
  }
  const logarithmic = kind === "log" && low > 0;
  const to = logarithmic ? Math.log : (value) => value;
  const back = logarithmic ? Math.exp : (value) => value;
  const [from, range] = [to(low), to(high) - to(low)];
  const place = (value) => (range > 0 ? (to(value) - from) / range : 0.5);
  return { n, place, ticks: [0, 0.5, 1].map((share) => (share === 1 ? high : share === 0 ? low : back(from + share * range))) };
}

/**
 * Colours cells by numbers.
 * @param kind "even" (linear), "log" (if all are positive) or "rank"
 * @returns colours (three bytes a cell) and a legend
 */
export function colourNumbers(values, kind, isCell) {
  const inCells = Array.from(values, (value, cell) => (isCell(cell) ? value : NaN));
  const { n, place, ticks } = placement(inCells, kind);
  const colours = new Uint8Array(3 * values.length);
  let missing = 0;
  inCells.forEach((value, cell) => {
    const known = Number.isFinite(value);
    if (!known && isCell(cell)) ++missing;
    const share = known ? clamp(place(value), 0, 1) : 0;
    colours.set(known ? SCALE[Math.round(255 * share)] : NEUTRAL, 3 * cell);
  });
  const positive = n > 0 && inCells.every((value) => !(value <= 0));
  const stops = SCALE.filter((_, k) => k % 17 === 0).map(hex);
  return { colours, legend: { kind: "scale", stops, ticks: n > 0 ? ticks.map(shortNumber) : [], missing, positive } };
}

/** Colours cells by classes: indices of `names`. The most frequent have colours of their own. */
export function colourClasses(indices, names, isCell) {
  const counts = new Array(names.length).fill(0);
  indices.forEach((index, cell) => isCell(cell) && ++counts[index]);
  const order = names.map((_, k) => k).filter((k) => counts[k] > 0);
  order.sort((a, b) => counts[b] - counts[a] || a - b);
  const own = order.slice(0, CLASSES.length);
  const colourOf = new Map(own.map((index, k) => [index, fromHex(CLASSES[k])]));
  const colours = new Uint8Array(3 * indices.length);
  indices.forEach((index, cell) => colours.set(colourOf.get(index) ?? NEUTRAL, 3 * cell));
  const entries = own.map((index, k) => ({ colour: CLASSES[k], name: names[index] || "(empty)", count: counts[index] }));
  const others = order.slice(own.length);
  if (others.length > 0)
    entries.push({
      colour: hex(NEUTRAL),
      name: others.length === 1 ? names[others[0]] || "(empty)" : `${others.length} others`,
      count: others.reduce((sum, index) => sum + counts[index], 0),
    });
  return { colours, legend: { kind: "classes", entries } };
}
