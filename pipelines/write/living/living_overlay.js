/* What lies over the body: colour scale, the answer in words, marked places, arrows of loads, a ruler. */

class Overlay {
  constructor(page) {
    this.page = page;
  }

  /* @param field  that is shown; null while it is looked for */
  draw(field, top, step) {
    this.#drawLegend(top, step);
    if (field) this.#say(field);
    this.#drawMarks(field);
    this.#drawRuler();
  }

  #drawLegend(top, step) {
    const { legend, state } = this.page;
    const { field } = state;
    const key = `${state.body.name}|${field ? field.name : ""}|${top}`;
    if (legend.dataset.key === key) return;
    legend.dataset.key = key;
    if (field && field.groups) legend.replaceChildren(element("b", {}, "leads"), this.#groups(field));
    else {
      const isStress = !field || field.unit === "Pa";
      const title = `${field ? field.name : "von Mises"}${isStress ? ", MPa" : ""}`;
      legend.replaceChildren(element("b", {}, title), this.#ramp(top, step, isStress ? 1e6 : 1));
    }
  }

  #groups({ groups, values }) {
    const { n, excluded } = this.page.state.body;
    const shown = new Set(values.subarray(0, n).filter((_, i) => !excluded[i]));
    const entries = groups.map((name, i) => {
      const swatch = element("i", { class: `swatch hatch-${i % 4}` });
      swatch.style.backgroundColor = `#${groupColours[i % 8]}`;
      return element("li", {}, swatch, readable(name));
    });
    return element("ul", {}, ...entries.filter((_, i) => shown.has(i)));
  }

  #ramp(top, step, unit) {
    const stops = Array.from(
      { length: 17 },
      (_, i) => `rgb(${colourOf(i / 16).map((c) => Math.round(255 * c))})`,
    );
    const ramp = element("div", { class: "ramp" });
    ramp.style.background = `linear-gradient(to top, ${stops.join()})`;
    const label = (value, text, kind = "") => {
      const made = element("span", { class: kind }, text);
      made.style.bottom = `${(100 * value) / top}%`;
      ramp.append(made);
    };
    for (let value = 0; value <= top * 0.94; value += step) label(value, digits(value / unit, 3));
    label(top, digits(top / unit, 4), "top");
    return ramp;
  }

  /* The answer in words. */
  #say(field) {
    const { body, mode, instant } = this.page.state;
    if (this.page.state.field) return this.#sayOfField(this.page.state.field);
    const judged = body.judged(field);
    const off = this.page.effects.off.size;
    const lines = [
      element(
        "span",
        {},
        mode === "now"
          ? `Largest at ${this.page.cycle.moment(instant)}`
          : off
            ? `Largest over the cycle, ${off} effect${off > 1 ? "s" : ""} off`
            : "Largest over the cycle",
      ),
    ];
    lines.push(element("b", {}, `${megapascals(judged.value)} MPa`));
    if (judged.name) lines.push(element("span", {}, `hot-spot stress at ${readable(judged.name)}`));
    const before = body.keys.places[0].value_Pa;
    if (mode !== "now" && off) {
      const change = judged.value / before - 1;
      lines.push(
        element(
          "span",
          {},
          `${change < 0 ? "−" : "+"}${Math.abs(100 * change).toFixed(1)} % against all effects`,
        ),
      );
    }
    if (body.keys.yield_Pa > 0)
      lines.push(element("span", {}, `safety against yield ${digits(body.keys.yield_Pa / judged.value, 3)}`));
    this.page.answer.replaceChildren(...lines);
    const share = (100 * body.keys.stress.error) / body.keys.peak_Pa;
    const part = this.page.cycle.is_all
      ? ""
      : ` Shown are ${this.page.cycle.n} of ${this.page.cycle.of_instants} instants.`;
    this.page.stateNote.textContent = `${body.keys.channels.length} unit loads in ${body.keys.stress.rank} modes of stress; with all effects, or without any one or one group of them, off by at most ${digits(share, 2)} % of the largest stress at every point and instant. Hatched: left out beside sharp edges.${part} ${body.keys.notice || ""}`;
  }

  #sayOfField({ name, unit, top, groups }) {
    const value = unit === "Pa" ? `${megapascals(top)} MPa` : digits(top);
    const lines = groups
      ? ["The effects that bring most of the largest von Mises stress at each point"]
      : [`Largest ${name}`, element("b", {}, value)];
    this.page.answer.replaceChildren(
      ...lines.map((line) => element("span", {}, line)),
      "of the run, with all its effects",
    );
  }

  #drawMarks(field) {
    const { body, mode, instant, place } = this.page.state;
    const { marks, camera } = this.page;
    marks.replaceChildren();
    const ring = (at, ink, radius, text) => {
      const [x, y] = camera.project(at);
      const isHidden = dot(camera.axes()[2], body.surface.normalAt(at)) < -0.05;
      for (const [width, kind] of [
        [5, "halo"],
        [2.4, ink],
      ])
        marks.append(
          drawn("circle", {
            cx: x,
            cy: y,
            r: radius,
            class: kind,
            "stroke-width": width,
            ...(isHidden ? { "stroke-dasharray": "3 4" } : {}),
          }),
        );
      const isRight = x > this.page.canvas.clientWidth - 180;
      if (text)
        marks.append(
          drawn(
            "text",
            {
              x: isRight ? x - radius - 5 : x + radius + 5,
              y: y - 8,
              "text-anchor": isRight ? "end" : "start",
            },
            text,
          ),
        );
    };
    if (this.page.ticks.arrows.checked && mode === "now") this.#drawArrows(instant);
    const governing = body.keys.places[0];
    const isGoverning = place && Math.hypot(...place.at_m.map((v, d) => v - governing.at_m[d])) < 1e-9;
    if (!isGoverning) ring(governing.at_m, "governs", 10, "governs");
    if (place && field)
      ring(
        place.at_m,
        isGoverning ? "governs" : "chosen",
        isGoverning ? 10 : 8,
        this.page.state.field ? "" : `${megapascals(field[place.row])} MPa`,
      );
    if (mode === "now" && field) {
      const node = body.largest(field).node;
      const moved = body.moved(node, instant);
      const magnified = this.page.magnification();
      const [x, y] = camera.project(body.positionOf(node).map((v, d) => v + magnified * moved[d]));
      for (const kind of ["halo", "cross"])
        marks.append(
          drawn("path", {
            d: `M${x - 7} ${y}h14M${x} ${y - 7}v14`,
            class: kind,
            "stroke-width": kind === "halo" ? 5 : 2,
          }),
        );
    }
  }

  #drawArrows(t) {
    const { body } = this.page.state;
    const { camera, marks } = this.page;
    const forces = body.keys.arrows.map((arrow) => body.force(arrow, t));
    body.arrowScale ||= body.keys.arrows.reduce((most, arrow) => {
      for (let i = 0; i < this.page.cycle.n; i += 7)
        most = Math.max(most, Math.hypot(...body.force(arrow, i)));
      return most;
    }, 1e-9);
    body.keys.arrows.forEach((arrow, i) => {
      const [fx, fy] = forces[i];
      const size = Math.hypot(fx, fy);
      if (size < 0.01 * body.arrowScale) return;
      const length = (0.2 * body.surface.size * size) / body.arrowScale;
      const tail = [
        arrow.at_m[0] - (fx / size) * length,
        arrow.at_m[1] - (fy / size) * length,
        arrow.at_m[2],
      ];
      const [[x1, y1], [x2, y2]] = [camera.project(tail), camera.project(arrow.at_m)];
      const pixels = Math.hypot(x2 - x1, y2 - y1);
      if (pixels < 6) return;
      const [ux, uy] = [(x2 - x1) / pixels, (y2 - y1) / pixels];
      const head = Math.min(12, pixels / 2);
      for (const [kind, width] of [
        ["halo", 6],
        ["load", 2.6],
      ])
        marks.append(
          drawn("line", {
            x1,
            y1,
            x2: x2 - ux * head,
            y2: y2 - uy * head,
            class: kind,
            "stroke-width": width,
          }),
        );
      const base = [x2 - ux * head, y2 - uy * head];
      marks.append(
        drawn("path", {
          class: "load-head",
          d: `M${x2} ${y2}L${base[0] - uy * 5} ${base[1] + ux * 5}L${base[0] + uy * 5} ${base[1] - ux * 5}Z`,
        }),
      );
      if (size > 0.08 * body.arrowScale)
        marks.append(
          drawn(
            "text",
            { x: x1, y: y1 - 5, "text-anchor": "middle" },
            size >= 1000 ? `${digits(size / 1000, 3)} kN` : `${digits(size, 3)} N`,
          ),
        );
    });
  }

  #drawRuler() {
    const metresPerPixel = (2 * this.page.camera.half) / Math.max(1, this.page.canvas.clientHeight);
    const length = roundStep(metresPerPixel * 60, 1);
    this.page.ruler.style.width = `${length / metresPerPixel}px`;
    this.page.ruler.firstChild.textContent = `${digits(1000 * length, 3)} mm`;
  }
}
