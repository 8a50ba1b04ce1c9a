"use strict";

/* Numbers of the page: one deflated block, whose sections are split into planes of bytes. */

const kinds = {
  i16: Int16Array,
  u16: Uint16Array,
  u32: Uint32Array,
  f32: Float32Array,
  u8: Uint8Array,
};

class Sections {
  constructor(bytes, index) {
    this.bytes = bytes;
    this.index = index;
  }

  static async unpack(text, index) {
    const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Sections(new Uint8Array(await new Response(stream).arrayBuffer()), index);
  }

  has(name) {
    return name in this.index;
  }

  get(name) {
    const [kind, first, count] = this.index[name];
    const Numbers = kinds[kind];
    const width = Numbers.BYTES_PER_ELEMENT;
    const joined = new Uint8Array(count * width);
    for (let plane = 0; plane < width; plane++)
      for (let i = 0, from = first + plane * count; i < count; i++)
        joined[i * width + plane] = this.bytes[from + i];
    return new Numbers(joined.buffer);
  }

  /* Numbers that were rounded to 16 bits between two ends. */
  range(name, [least, most]) {
    return Float32Array.from(this.get(name), (step) => least + (step / 65535) * (most - least));
  }
}

/* Text and elements. */

const find = (id) => document.getElementById(id);
const readable = (name) => name.replace(/_/g, " ").replace(/\//g, " / ");
const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;

function digits(value, count = 4) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (value === 0) return "0";
  if (size >= 1e7 || size < 1e-4) return value.toExponential(count - 1);
  return String(+value.toPrecision(count));
}

function megapascals(pascals) {
  const value = pascals / 1e6;
  return Math.abs(value) >= 100
    ? value.toFixed(1)
    : Math.abs(value) >= 1
      ? value.toFixed(2)
      : digits(value, 3);
}

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

function drawn(tag, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/* A row of buttons of which one is pressed. */
function choice(label, options, choose) {
  const group = element("div", { class: "choice", role: "group", "aria-label": label });
  for (const [value, text] of options)
    group.append(
      element("button", { type: "button", "data-value": value, onclick: () => choose(value) }, text),
    );
  return group;
}

function press(group, value) {
  for (const button of group.children)
    button.setAttribute("aria-pressed", String(button.dataset.value === String(value)));
}

/* The largest round step of which `count` fill the span. */
function roundStep(span, count) {
  const raw = span / count || 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  return power * [1, 2, 5, 10].find((step) => step * power >= raw * 0.999);
}

/* The cycle that the page shows. */
class Cycle {
  constructor(keys, sections) {
    Object.assign(this, keys);
    this.n = keys.instants;
    this.time = sections.range("cycle/time", keys.time_s);
    this.angle = sections.range("cycle/angle", keys.angle_deg);
    this.turn = sections.range("cycle/turn", keys.turn);
  }

  /* "turn 4, 30°" */
  moment(t) {
    if (this.is_run_up) return `${digits(this.time[t])} s`;
    return `turn ${Math.round(this.turn[t])}, ${Math.round(this.angle[t]) % 360}°`;
  }

  axis() {
    return Array.from({ length: this.n }, (_, t) => t);
  }

  /* Where turns begin, or times of a run-up: [instant, text]. */
  ticks(first, last, width) {
    const most = Math.max(1, Math.floor(width / 70));
    const marks = [];
    if (this.is_run_up || !this.per_turn) {
      const every = Math.max(1, Math.round(this.n / most));
      for (let t = 0; t < this.n; t += every) marks.push([t, `${digits(this.time[t], 3)} s`]);
      return marks;
    }
    const turns = Math.ceil(this.n / this.per_turn);
    if (turns === 1) return [0, 90, 180, 270].map((angle) => [(angle / 360) * this.per_turn, `${angle}°`]);
    const every = Math.ceil(turns / most);
    for (let turn = 0; turn < turns; turn += every)
      marks.push([turn * this.per_turn, `turn ${Math.round(this.turn[turn * this.per_turn])}`]);
    return marks;
  }
}
