/* The loads over the cycle, and internal forces along an axis. */

class Loads {
  constructor(page) {
    this.page = page;
    this.charts = [];
    const { quantities, resultants } = page.keys;
    const { cycle, sections } = page;
    const choose = (t) => page.setInstant(t);
    const chart = new Chart("A load over the cycle", {
      choose,
      say: (t) => cycle.moment(t),
      ticks: (...span) => cycle.ticks(...span),
    });
    chart.x = cycle.axis();
    this.charts.push(chart);
    const about = element("p", { class: "note" });
    const list = element(
      "select",
      { "aria-label": "Load", onchange: () => show(quantities[+list.value]) },
      ...quantities.map((own, i) => element("option", { value: i }, `${readable(own.name)} [${own.unit}]`)),
    );
    const show = (quantity) => {
      const values = sections.range(`quantity/${quantity.name}`, quantity.range);
      const mean = values.reduce((sum, v) => sum + v, 0) / values.length;
      const [least, most] = quantity.range.map((v) => digits(v));
      chart.options.unit = quantity.unit;
      chart.series = [{ values, ink: "accent" }];
      chart.draw();
      about.textContent = `${quantity.meaning || readable(quantity.name)}: largest ${most}, least ${least}, mean ${digits(mean)} ${quantity.unit}`;
    };
    const polars = element("div", { class: "polars" });
    for (const resultant of resultants) {
      const [x, y] = ["x", "y"].map((d) => sections.range(`resultant/${resultant.name}.f${d}`, resultant[d]));
      const polar = new Polar(`Force at ${readable(resultant.name)} over the cycle`, cycle, x, y, choose);
      if (polar.largest < 1e-6) continue;
      this.charts.push(polar);
      const title = element("figcaption", { title: resultant.meaning }, readable(resultant.name));
      polars.append(element("figure", {}, polar.holder, title));
    }
    /* A torque or a force tells most at first. */
    const isFirst = (unit) => quantities.findIndex((own) => own.unit === unit && own.range[1] > 1e-3);
    list.value = [isFirst("N m"), isFirst("N"), 0].find((i) => i >= 0);
    show(quantities[+list.value]);
    this.section = element(
      "section",
      { id: "loads-over-the-cycle", "aria-labelledby": "loads-title" },
      element("h2", { id: "loads-title" }, "The loads as they turn"),
      element("div", { class: "panel" }, list, about, chart.holder),
      polars,
    );
  }

  choose(t) {
    for (const chart of this.charts) chart.chosen = t;
  }
}

/* Normal and shear force, bending moment, torque and torsional stress along the axis: those of the instant,
   within their range over the cycle. */
class Diagrams {
  constructor(page) {
    this.page = page;
    const titles = [
      ["Normal force", "N"],
      ["Shear force", "N"],
      ["Bending moment", "N m"],
      ["Torque", "N m"],
      ["Torsional stress", "MPa"],
    ];
    this.charts = titles.map(([title, unit]) => {
      const chart = new Chart(`${title} along the axis`, {
        unit,
        kind: "diagram",
        say: (i) => `z = ${digits(chart.x[i])} mm`,
        ticks: (first, last) => [first, last].map((z) => [z, `${digits(z)} mm`]),
      });
      return chart;
    });
    const figures = this.charts.map((chart, i) =>
      element("figure", {}, element("figcaption", {}, `${titles[i][0]} [${titles[i][1]}]`), chart.holder),
    );
    this.title = element("p", { class: "note" });
    this.section = element(
      "section",
      { id: "along", "aria-labelledby": "along-title" },
      element("h2", { id: "along-title" }, "Along the axis"),
      this.title,
      element("div", { class: "diagrams" }, ...figures),
    );
  }

  /* Figures of a section plane: resultants about its own axis, and the torque's stress T r / I_p. */
  #figures(body, plane, t) {
    const [fx, fy, fz, mx, my, mz] = body.resultants(plane, t);
    const { axis_m, radius_m, bore_m } = body.keys.sections[plane];
    const torque = mz - (axis_m[0] * fy - axis_m[1] * fx);
    const bending = Math.hypot(mx - axis_m[1] * fz, my + axis_m[0] * fz);
    const polar = (Math.PI / 2) * (radius_m ** 4 - bore_m ** 4);
    return [fz, Math.hypot(fx, fy), bending, torque, (torque * radius_m) / polar / 1e6];
  }

  /* @param isNew  the loads have changed */
  draw(t, isNew) {
    const { bodies, state, cycle } = this.page;
    const body = state.body.keys.sections ? state.body : bodies.find((own) => own.keys.sections);
    const planes = body.keys.sections;
    if (isNew || this.body !== body) this.#findRange(body, planes);
    const now = planes.map((_, plane) => this.#figures(body, plane, t));
    this.charts.forEach((chart, i) => {
      chart.series = [{ values: now.map((row) => row[i]), ink: "accent" }];
      chart.draw();
    });
    this.title.textContent = `The ${readable(body.name)} at ${cycle.moment(t)}, within the range over the cycle; about each section's own axis.`;
  }

  #findRange(body, planes) {
    this.body = body;
    const { cycle } = this.page;
    const stride = Math.max(1, Math.floor(cycle.n / 240));
    for (const chart of this.charts) {
      chart.x = planes.map((plane) => 1000 * plane.z_m);
      chart.bands = [{ low: planes.map(() => Infinity), high: planes.map(() => -Infinity) }];
    }
    for (let plane = 0; plane < planes.length; plane++)
      for (let t = 0; t < cycle.n; t += stride)
        this.#figures(body, plane, t).forEach((value, i) => {
          const [band] = this.charts[i].bands;
          band.low[plane] = Math.min(band.low[plane], value);
          band.high[plane] = Math.max(band.high[plane], value);
        });
  }
}
