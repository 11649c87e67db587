// What is known of each cell: values to colour by, the row of a cell, seeds without a cell.

const STATUS = ["ok", "hidden", "duplicate"];

function components(values, dimension, cell) {
  return Array.from({ length: dimension }, (_, k) => values[dimension * cell + k]);
}

function pointText(point) {
  return point.every(Number.isFinite) ? point.join(", ") : "–";
}

function columnText(diagram, k, cell) {
  const { type, values } = diagram.columns[k];
  const value = diagram.arrays[`column${k}`][cell];
  if (type === "text") return values[value];
  return Number.isNaN(value) ? "" : String(value);
}

/** Names and texts of everything known of a seed, with the names of `--table`. */
export function rowOf(diagram, cell) {
  const { position, weight, status, measure, centroid, second_moment, neighbors } = diagram.arrays;
  const d = diagram.dimension;
  return [
    ["seed", String(cell)],
    ...diagram.columns.map(({ name }, k) => [name, columnText(diagram, k, cell)]),
    ["position", pointText(components(position, d, cell))],
    ["weight", String(weight[cell])],
    ["status", STATUS[status[cell]]],
    ["measure", String(measure[cell])],
    ["centroid", pointText(components(centroid, d, cell))],
    ["second_moment", String(second_moment[cell])],
    ["neighbors", String(neighbors[cell])],
  ];
}

/** What cells can be coloured by: a name, and `numbers` or `classes` with their `names`. */
export function measuresOf(diagram) {
  const { measure, weight, neighbors } = diagram.arrays;
  const results = [
    { name: "measure", numbers: measure },
    { name: "weight", numbers: weight },
    { name: "neighbors", numbers: neighbors },
  ];
  const columns = diagram.columns.map(({ name, type, values }, k) => {
    const array = diagram.arrays[`column${k}`];
    return type === "text" ? { name, classes: array, names: values } : { name, numbers: array };
  });
  return [...results, ...columns];
}

/** Seeds without a cell: [seed, "hidden" or "duplicate"]. */
export function withoutCell(diagram) {
  const found = [];
  diagram.arrays.status.forEach((status, seed) => status !== 0 && found.push([seed, STATUS[status]]));
  return found;
}

const grouped = (count) => count.toLocaleString("en-US");

/** The self-check of the run in words. */
export function checkLine({ cells, hidden, duplicate, measure, domain_measure }) {
  const defect = domain_measure > 0 ? measure / domain_measure - 1 : 0;
  const sum = defect === 0 ? "1" : `1 ${defect < 0 ? "−" : "+"} ${Math.abs(defect).toExponential(1)}`;
  return `${grouped(cells)} cells, ${grouped(hidden)} hidden, ${grouped(duplicate)} duplicate; sum of measures / domain = ${sum}`;
}
