// The controls beside the picture. Text of the diagram is only ever set as text, never as HTML.
import { checkLine, measuresOf, rowOf, withoutCell } from "./rows.js";
import { KEYS } from "./gestures.js";
import { toUser } from "./model.js";
import { shortNumber } from "./scales.js";

const AT_ONCE = 200; // rows of the list of seeds without a cell

function make(tag, text = "", attributes = {}) {
  const node = document.createElement(tag);
  node.textContent = text;
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  return node;
}

const byId = (id) => document.getElementById(id);

export class Panel {
  /** @param change called with what was changed @param choose called with a seed */
  constructor(diagram, model, { change, choose }) {
    this.diagram = diagram;
    byId("check").textContent = checkLine(diagram.check);
    byId("map").textContent = diagram.map ?? "";
    this.fillColours();
    this.fillKeys();
    this.fillWithoutCell(choose);
    byId("slice-part").hidden = model.flat;
    byId("apart-part").hidden = !model.solid;
    const listen = (id, event, read) => byId(id).addEventListener(event, () => change(read(byId(id))));
    listen("colour", "change", (node) => ({ colour: Number(node.value) }));
    listen("scale", "change", (node) => ({ scale: node.value }));
    listen("from", "change", (node) => ({ from: this.limit(node, -Infinity) }));
    listen("to", "change", (node) => ({ to: this.limit(node, Infinity) }));
    listen("depth", "input", (node) => ({ depth: Number(node.value) }));
    listen("whole", "change", (node) => ({ whole: node.checked }));
    listen("apart", "input", (node) => ({ apart: Number(node.value) }));
    listen("dots", "change", (node) => ({ dots: node.checked }));
    byId("flip").addEventListener("click", () => change({ flip: true }));
    for (const button of document.querySelectorAll("[data-axis]"))
      button.addEventListener("click", () => change({ axis: button.dataset.axis }));
    byId("find").addEventListener("submit", (event) => {
      event.preventDefault();
      const text = byId("seed").value.trim();
      if (/^\d+$/.test(text) && Number(text) < diagram.seeds) choose(Number(text));
      else this.say(`There is no seed ${text}: they are 0 to ${diagram.seeds - 1}.`);
    });
  }

  /** The number in a field, or what stands for an empty one. */
  limit(node, none) {
    const text = node.value.trim().replace("−", "-");
    if (text !== "" && Number.isFinite(Number(text))) return Number(text);
    if (text !== "") this.say(`"${text}" is not a number.`);
    node.value = "";
    return none;
  }

  fillColours() {
    this.measures = measuresOf(this.diagram);
    byId("colour").append(
      make("option", "cells apart", { value: -1 }),
      ...this.measures.map(({ name }, k) => make("option", name, { value: k })),
    );
  }

  fillKeys() {
    byId("keys").append(
      ...KEYS.flatMap(([keys, words]) => {
        const names = make("dt");
        for (const key of keys.split(" ")) names.append(make("kbd", key), " ");
        return [names, make("dd", words)];
      }),
    );
  }

  fillWithoutCell(choose) {
    const seeds = withoutCell(this.diagram);
    const { hidden, duplicate } = this.diagram.check;
    byId("without").hidden = seeds.length === 0;
    byId("without-count").textContent = `Without a cell: ${hidden} hidden, ${duplicate} duplicate`;
    const list = byId("without-list");
    const more = byId("without-more");
    let listed = 0;
    const extend = () => {
      for (const [seed, status] of seeds.slice(listed, listed + AT_ONCE)) {
        const button = make("button", `seed ${seed}, ${status}`, { type: "button" });
        button.addEventListener("click", () => choose(seed));
        const item = make("li");
        item.append(button);
        list.append(item);
      }
      listed = Math.min(seeds.length, listed + AT_ONCE);
      more.hidden = listed === seeds.length;
      more.textContent = `Show ${Math.min(AT_ONCE, seeds.length - listed)} more of ${seeds.length - listed}`;
    };
    more.addEventListener("click", extend);
    extend();
  }

  /** Shows the state of the controls. */
  show(state) {
    byId("colour").value = state.colour;
    byId("scale").value = state.scale;
    byId("whole").checked = state.whole;
    byId("dots").checked = state.dots;
    byId("apart").value = state.apart;
    byId("depth").value = state.depth;
    if (state.from === -Infinity) byId("from").value = "";
    if (state.to === Infinity) byId("to").value = "";
    for (const button of document.querySelectorAll("[data-axis]"))
      button.setAttribute("aria-pressed", String(button.dataset.axis === state.axis));
    for (const id of ["depth", "flip", "whole"]) byId(id).disabled = state.axis === "none";
    const axis = "xyz".indexOf(state.axis);
    byId("depth-value").textContent =
      axis < 0 ? "" : `${state.axis} = ${shortNumber(toUser(this.diagram, state.distance, axis))}`;
  }

  showLegend(legend) {
    for (const id of ["scale-part", "only-part"]) byId(id).hidden = legend.kind !== "scale";
    byId("scale").querySelector("[value=log]").disabled = !legend.positive;
    const box = byId("legend");
    box.replaceChildren();
    if (legend.kind === "scale" && legend.ticks.length === 0) {
      box.append(make("p", "no cell has a value"));
    } else if (legend.kind === "scale") {
      const bar = make("div", "", { class: "bar", role: "img", "aria-label": `from ${legend.ticks[0]} to ${legend.ticks.at(-1)}` });
      bar.style.background = `linear-gradient(to right, ${legend.stops.join(", ")})`;
      const ticks = make("div", "", { class: "ticks" });
      ticks.append(...legend.ticks.map((tick) => make("span", tick)));
      box.append(bar, ticks);
      if (legend.missing > 0) box.append(make("p", `grey: no value (${legend.missing})`));
    } else if (legend.kind === "classes") {
      const list = make("ul", "", { class: "classes" });
      for (const { colour, name, count } of legend.entries) {
        const swatch = make("span", "", { class: "swatch" });
        swatch.style.background = colour;
        const item = make("li");
        item.append(swatch, make("span", name), make("small", ` ${count}`));
        list.append(item);
      }
      box.append(list);
    } else {
      box.append(make("p", "Colours tell cells from their neighbours."));
    }
  }

  showRow(cell) {
    this.say(cell < 0 ? "Tap a cell, or enter the number of a seed." : "");
    const table = byId("row");
    table.replaceChildren();
    if (cell < 0) return;
    for (const [name, text] of rowOf(this.diagram, cell)) {
      const row = make("tr");
      row.append(make("th", name, { scope: "row" }), make("td", text));
      table.append(row);
    }
    byId("seed").value = cell;
  }

  say(text) {
    byId("hint").textContent = text;
  }
}

/** A failure, in place of the picture. */
export function showFailure(text) {
  const message = byId("message");
  message.textContent = text;
  message.hidden = false;
}
