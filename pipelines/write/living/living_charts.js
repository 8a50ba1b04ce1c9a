/* Charts on canvases, with the values under the pointer. */

function paint(canvas) {
  const sharpness = Math.min(devicePixelRatio, 3);
  const { clientWidth: width, clientHeight: height } = canvas;
  canvas.width = Math.max(1, width * sharpness);
  canvas.height = Math.max(1, height * sharpness);
  const pen = canvas.getContext("2d");
  pen.scale(sharpness, sharpness);
  const style = getComputedStyle(document.documentElement);
  const ink = (name) => style.getPropertyValue(`--${name}`).trim();
  pen.font = "11.5px system-ui, sans-serif";
  pen.lineJoin = "round";
  return { pen, width, height, ink };
}

function stroke(pen, colour, width, points, dash = []) {
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.setLineDash(dash);
  pen.beginPath();
  points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.stroke();
  pen.setLineDash([]);
}

/* A canvas that shows what is nearest to the pointer, and chooses it where that presses or drags. */
class PointedChart {
  constructor(label, kind, choose) {
    this.canvas = element("canvas", { role: "img", "aria-label": label });
    this.tip = element("div", { class: "tip", hidden: true });
    this.holder = element("div", { class: `chart ${kind || ""}` }, this.canvas, this.tip);
    this.canvas.addEventListener("pointermove", (event) => {
      this.hovered = this.nearest(event);
      if (event.buttons && choose) choose(this.hovered);
      this.draw();
    });
    this.canvas.addEventListener("pointerdown", (event) => choose && choose(this.nearest(event)));
    this.canvas.addEventListener("pointerleave", () => {
      this.hovered = null;
      this.draw();
    });
    charts.push(this);
  }
}

/* Series over one axis. A series has `values`, `ink`, `width`, `dash`, `label`; bands have `low` and `high`. */
class Chart extends PointedChart {
  constructor(label, options = {}) {
    super(label, options.kind, options.choose);
    this.options = options;
    this.series = [];
    this.bands = [];
    this.x = [];
    this.chosen = null;
  }

  nearest(event) {
    const box = this.canvas.getBoundingClientRect();
    const [left, right] = this.#sides();
    const share = (event.clientX - box.left - left) / (box.width - left - right);
    const wanted = this.x[0] + share * (this.x[this.x.length - 1] - this.x[0]);
    let best = 0;
    for (let i = 1; i < this.x.length; i++)
      if (Math.abs(this.x[i] - wanted) < Math.abs(this.x[best] - wanted)) best = i;
    return best;
  }

  #sides() {
    return [52, 12];
  }

  draw() {
    if (!this.canvas.clientWidth || !this.x.length) return;
    const { pen, width, height, ink } = paint(this.canvas);
    const [left, right] = this.#sides();
    const [top, bottom] = [8, 22];
    let low = this.options.fromZero ? 0 : Infinity;
    let high = -Infinity;
    for (const { values } of this.series)
      for (const v of values) [low, high] = [Math.min(low, v), Math.max(high, v)];
    for (const band of this.bands)
      for (const v of [...band.low, ...band.high]) [low, high] = [Math.min(low, v), Math.max(high, v)];
    if (!(high > low)) [low, high] = [low - Math.abs(low) / 2 - 1e-9, low + Math.abs(low) / 2 + 1e-9];
    const spare = 0.06 * (high - low);
    high += spare;
    if (!this.options.fromZero || low < 0) low -= spare;
    const [first, last] = [this.x[0], this.x[this.x.length - 1]];
    const X = (x) => left + ((x - first) / (last - first || 1)) * (width - left - right);
    const Y = (y) => top + ((high - y) / (high - low)) * (height - top - bottom);

    pen.textAlign = "right";
    pen.textBaseline = "middle";
    const step = roundStep(high - low, height > 120 ? 5 : 3);
    for (let y = Math.ceil(low / step) * step; y <= high; y += step) {
      const isZero = Math.abs(y) < step * 1e-6;
      stroke(pen, ink(isZero ? "axis" : "rule"), 1, [
        [left, Y(y)],
        [width - right, Y(y)],
      ]);
      pen.fillStyle = ink("soft");
      pen.fillText(digits(isZero ? 0 : y, 5), left - 6, Y(y));
    }
    pen.textAlign = "center";
    for (const [x, text] of this.options.ticks ? this.options.ticks(first, last, width) : []) {
      stroke(pen, ink("rule"), 1, [
        [X(x), top],
        [X(x), height - bottom],
      ]);
      pen.fillStyle = ink("soft");
      pen.fillText(text, Math.min(Math.max(X(x), left + 8), width - 26), height - bottom / 2);
    }
    for (const band of this.bands) {
      pen.fillStyle = ink("band");
      pen.beginPath();
      this.x.forEach((x, i) => pen.lineTo(X(x), Y(band.high[i])));
      for (let i = this.x.length - 1; i >= 0; i--) pen.lineTo(X(this.x[i]), Y(band.low[i]));
      pen.fill();
    }
    for (const series of this.series)
      stroke(
        pen,
        ink(series.ink),
        series.width || 1.6,
        this.x.map((x, i) => [X(x), Y(series.values[i])]),
        series.dash,
      );
    const mark = (i, colour) => {
      stroke(pen, colour, 1, [
        [X(this.x[i]), top],
        [X(this.x[i]), height - bottom],
      ]);
      for (const series of this.series) {
        pen.fillStyle = ink(series.ink);
        pen.beginPath();
        pen.arc(X(this.x[i]), Y(series.values[i]), 3.5, 0, 7);
        pen.fill();
      }
    };
    if (this.chosen !== null && this.chosen < this.x.length) mark(this.chosen, ink("ink"));
    this.tip.hidden = this.hovered === null || this.hovered === undefined;
    if (this.tip.hidden) return;
    mark(this.hovered, ink("soft"));
    const values = this.series.map(
      (s) => `${digits(s.values[this.hovered])} ${this.options.unit || ""}${s.label ? ` ${s.label}` : ""}`,
    );
    this.tip.textContent = `${this.options.say ? this.options.say(this.hovered) : digits(this.x[this.hovered])}: ${values.join(", ")}`;
    const x = X(this.x[this.hovered]);
    this.tip.style.left = `${Math.max(0, Math.min(width - this.tip.offsetWidth, x > width / 2 ? x - this.tip.offsetWidth - 10 : x + 10))}px`;
  }
}

/* A force as it turns: its tip over the cycle, the turn of the instant in front. */
class Polar extends PointedChart {
  constructor(label, cycle, x, y, choose) {
    super(label, "polar", choose);
    Object.assign(this, { cycle, x, y, chosen: 0 });
    this.largest = x.reduce((most, value, t) => Math.max(most, Math.hypot(value, y[t])), 0);
  }

  nearest(event) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left - box.width / 2, box.height / 2 - (event.clientY - box.top)];
    let best = 0;
    let least = Infinity;
    for (let t = 0; t < this.cycle.n; t++) {
      const distance = (this.x[t] * this.scale - x) ** 2 + (this.y[t] * this.scale - y) ** 2;
      if (distance < least) [least, best] = [distance, t];
    }
    return best;
  }

  draw() {
    if (!this.canvas.clientWidth) return;
    const { pen, width, height, ink } = paint(this.canvas);
    const radius = Math.min(width, height) / 2;
    const [cx, cy] = [width / 2, height / 2];
    this.scale = (radius - 14) / (this.largest * 1.03 || 1);
    const at = (t) => [cx + this.x[t] * this.scale, cy - this.y[t] * this.scale];
    const step = roundStep(this.largest, 2);
    for (let r = step; r <= this.largest * 1.02; r += step) {
      pen.strokeStyle = ink("rule");
      pen.lineWidth = 1;
      pen.beginPath();
      pen.arc(cx, cy, r * this.scale, 0, 7);
      pen.stroke();
      pen.fillStyle = ink("soft");
      pen.fillText(r >= 1000 ? `${digits(r / 1000)} kN` : `${digits(r)} N`, cx + 3, cy - r * this.scale + 12);
    }
    stroke(pen, ink("axis"), 1, [
      [cx - radius + 6, cy],
      [cx + radius - 6, cy],
    ]);
    stroke(pen, ink("axis"), 1, [
      [cx, cy - radius + 6],
      [cx, cy + radius - 6],
    ]);
    pen.fillStyle = ink("soft");
    pen.fillText("x", cx + radius - 12, cy - 4);
    pen.fillText("y", cx + 4, cy - radius + 14);
    const all = Array.from({ length: this.cycle.n }, (_, t) => at(t));
    stroke(pen, ink("faint"), 1, all);
    const turn = this.cycle.turn[this.chosen];
    stroke(
      pen,
      ink("accent"),
      1.8,
      all.filter((_, t) => this.cycle.turn[t] === turn),
    );
    const arrow = (t, colour) => {
      stroke(pen, colour, 1.8, [[cx, cy], at(t)]);
      pen.fillStyle = colour;
      pen.beginPath();
      pen.arc(...at(t), 4, 0, 7);
      pen.fill();
    };
    arrow(this.chosen, ink("mark"));
    this.tip.hidden = this.hovered === null || this.hovered === undefined;
    if (this.tip.hidden) return;
    arrow(this.hovered, ink("ink"));
    const [x, y] = [this.x[this.hovered], this.y[this.hovered]];
    const degrees = Math.round((Math.atan2(y, x) * 180) / Math.PI);
    this.tip.textContent = `${this.cycle.moment(this.hovered)}: ${digits(Math.hypot(x, y))} N at ${degrees}°`;
    this.tip.style.left = "0";
  }
}

const charts = [];
