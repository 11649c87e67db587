// Colours of numbers and of classes, in those of the tool's pictures: `scale`, hex colours from the least to the greatest
// number, and `palette`, one for each class.
import { clamp } from "./vectors.js";

export const NEUTRAL = [150, 154, 160]; // no value, or one of the other classes

function hex(colour) {
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
export function colourNumbers(values, kind, isCell, scale) {
  const bytes = scale.map(fromHex);
  const inCells = Array.from(values, (value, cell) => (isCell(cell) ? value : NaN));
  const { n, place, ticks } = placement(inCells, kind);
  const colours = new Uint8Array(3 * values.length);
  let missing = 0;
  inCells.forEach((value, cell) => {
    const known = Number.isFinite(value);
    if (!known && isCell(cell)) ++missing;
    const share = known ? clamp(place(value), 0, 1) : 0;
    colours.set(known ? bytes[Math.round((bytes.length - 1) * share)] : NEUTRAL, 3 * cell);
  });
  const positive = n > 0 && inCells.every((value) => !(value <= 0));
  const stops = scale.filter((_, k) => k % 17 === 0);
  return { colours, legend: { kind: "scale", stops, ticks: n > 0 ? ticks.map(shortNumber) : [], missing, positive } };
}

const order = (a, b) => (a < b ? -1 : a > b ? 1 : 0);
const isColour = (text) => /^#([0-9a-f]{3}|[0-9a-f]{6})$/i.test(text);
const inFull = (text) => (text.length === 4 ? `#${[1, 2, 3].map((k) => text[k] + text[k]).join("")}` : text);

/**
 * Colours cells by classes: indices of `names`, which may be colours themselves. Else the most frequent have colours of their
 * own, in the order of their names.
 */
export function colourClasses(indices, names, isCell, palette) {
  const counts = new Array(names.length).fill(0);
  indices.forEach((index, cell) => isCell(cell) && ++counts[index]);
  const frequent = names.map((_, k) => k).filter((k) => counts[k] > 0 && names[k] !== "");
  frequent.sort((a, b) => counts[b] - counts[a] || a - b);
  const colours = new Uint8Array(3 * indices.length);
  const paint = (colourOf) => indices.forEach((index, cell) => colours.set(colourOf.get(index) ?? NEUTRAL, 3 * cell));
  if (frequent.length > 0 && frequent.every((k) => isColour(names[k]))) {
    paint(new Map(frequent.map((index) => [index, fromHex(inFull(names[index]))])));
    return { colours, legend: { kind: "classes", entries: [] } };
  }
  const own = frequent.slice(0, palette.length).sort((a, b) => order(names[a], names[b]));
  paint(new Map(own.map((index, k) => [index, fromHex(palette[k])])));
  const entries = own.map((index, k) => ({ colour: palette[k], name: names[index], count: counts[index] }));
  const others = frequent.slice(own.length);
  const sum = (list) => list.reduce((total, index) => total + counts[index], 0);
  if (others.length > 0) entries.push({ colour: hex(NEUTRAL), name: `${others.length} others`, count: sum(others) });
  const empty = names.map((_, k) => k).filter((k) => counts[k] > 0 && names[k] === "");
  if (empty.length > 0) entries.push({ colour: hex(NEUTRAL), name: "(empty)", count: sum(empty) });
  return { colours, legend: { kind: "classes", entries } };
}
