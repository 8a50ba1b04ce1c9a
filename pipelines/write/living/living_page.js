/* The page: what is chosen, and everything that follows from it. */

class Page {
  constructor(keys, sections) {
    this.keys = keys;
    this.cycle = new Cycle(keys.cycle, sections);
    this.sections = sections;
    this.bodies = keys.bodies.map((own) => new Body(own, sections, this.cycle, keys.toggles));
    this.state = {
      body: this.bodies[0],
      mode: "largest",
      instant: 0,
      magnified: 0,
      place: null,
      isPlaying: false,
      field: null,
    };
    this.largest = new Map();
    this.job = 0;
  }

  /* ---- Elements ---- */

  build(holder) {
    if (this.bodies.length) holder.append(this.#stage());
    if (this.cycle.n > 1 && this.keys.quantities.length) {
      this.loads = new Loads(this);
      holder.append(this.loads.section);
    }
    if (this.bodies.some((body) => body.keys.sections)) {
      this.diagrams = new Diagrams(this);
      holder.append(this.diagrams.section);
    }
    if (this.bodies.length) this.#start();
    this.setInstant(this.state.instant, false);
    new ResizeObserver(() => this.redraw()).observe(holder);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
  }

  #stage() {
    const pick = (name) => this.showBody(this.bodies.find((body) => body.name === name));
    this.bodyChoice = choice(
      "Body",
      this.bodies.map((body) => [body.name, readable(body.name)]),
      pick,
    );
    this.modeChoice = choice(
      "What is shown",
      [
        ["largest", "Largest over the cycle"],
        ["now", "This instant"],
      ],
      (mode) => this.showMode(mode),
    );
    const tick = (label, isOn) => {
      const box = element("input", { type: "checkbox", onchange: () => this.render() });
      box.checked = isOn;
      return [box, element("label", { class: "tick" }, box, label)];
    };
    this.fieldChoice = element("select", {
      "aria-label": "Field",
      onchange: () => this.showField(this.state.body.fields[+this.fieldChoice.value - 1] || null),
    });
    const [lines, linesLabel] = tick("Contours", true);
    const [mesh, meshLabel] = tick("Mesh", false);
    const [arrows, arrowsLabel] = tick("Loads", true);
    this.ticks = { lines, mesh, arrows };
    this.magnifier = element("input", {
      type: "range",
      min: 0,
      max: 100,
      value: 0,
      "aria-label": "Magnification of the deformed shape",
      oninput: () => this.magnify(+this.magnifier.value),
    });
    this.magnified = element("output", {}, "off");
    this.canvas = element("canvas", {
      id: "body-view",
      tabindex: 0,
      role: "img",
      "aria-label":
        "The body by von Mises stress. Arrow keys turn it, plus and minus zoom, F shows all of it, space plays the cycle.",
    });
    this.marks = drawn("svg", { class: "marks", "aria-hidden": "true" });
    this.answer = element("div", { class: "answer", role: "status" });
    this.legend = element("div", { class: "legend", "aria-hidden": "true" });
    this.ruler = element("div", { class: "ruler" }, element("span"));
    this.tip = element("div", { class: "tip", hidden: true });
    this.progress = element("progress", {
      max: 1,
      value: 0,
      hidden: true,
      "aria-label": "Largest over the cycle",
    });
    const home = element(
      "button",
      { type: "button", class: "small home", onclick: () => this.fly(this.home()) },
      "Fit",
    );
    const view = element(
      "div",
      { class: "view" },
      this.canvas,
      this.marks,
      this.legend,
      this.answer,
      this.ruler,
      home,
      this.progress,
      this.tip,
    );

    this.places = new Places((place) => this.select(place));
    this.effects = new Effects(this.keys, () => this.effectsChanged());
    const panes = { places: this.places.holder, effects: this.effects.holder };
    const paneChoice = choice(
      "Side",
      [
        ["places", "Places"],
        ["effects", "Effects"],
      ],
      (name) => {
        press(paneChoice, name);
        for (const [own, pane] of Object.entries(panes)) pane.hidden = own !== name;
      },
    );
    this.showPane = (name) => paneChoice.querySelector(`[data-value=${name}]`).click();
    const side = element("div", { class: "side" }, paneChoice, ...Object.values(panes));
    this.showPane("places");

    this.course = new Chart("Stress at the chosen place over the cycle", {
      unit: "MPa",
      fromZero: true,
      kind: "course",
      choose: (t) => this.setInstant(t),
      say: (t) => this.cycle.moment(t),
      ticks: (...span) => this.cycle.ticks(...span),
    });
    this.courseTitle = element("p", { class: "course-title" });
    this.player = element(
      "button",
      { type: "button", class: "small", "aria-pressed": "false", onclick: () => this.play() },
      "Play",
    );
    this.slider = element("input", {
      id: "instant",
      type: "range",
      min: 0,
      max: this.cycle.n - 1,
      value: 0,
      "aria-label": "Instant of the cycle",
      oninput: () => this.setInstant(+this.slider.value),
    });
    this.moment = element("output", { for: "instant" });
    const bar = element(
      "div",
      { class: "tools" },
      this.bodyChoice,
      this.fieldChoice,
      this.modeChoice,
      linesLabel,
      meshLabel,
      arrowsLabel,
      element("label", { class: "tick" }, "Deformed ", this.magnifier, this.magnified),
    );
    const time = element(
      "div",
      { class: "time" },
      this.courseTitle,
      this.course.holder,
      element("div", { class: "run" }, this.player, this.slider, this.moment),
    );
    this.stage = element(
      "section",
      { id: "stage", "aria-labelledby": "stage-title" },
      element("h2", { id: "stage-title" }, "The body under load"),
      element("div", { class: "stage" }, bar, element("div", { class: "two" }, view, side), time),
    );
    this.stateNote = element("p", { class: "note" });
    this.stage.append(this.stateNote);
    return this.stage;
  }

  /* ---- State ---- */

  #start() {
    this.view = new View(this.canvas);
    this.camera = new Camera(this.canvas);
    this.course.x = this.cycle.axis();
    this.overlay = new Overlay(this);
    this.hand = new Hand(this);
    for (const card of document.querySelectorAll(".card[data-body]")) {
      const body = this.bodies.find((own) => own.name === card.dataset.body);
      if (!body) continue;
      const go = element(
        "button",
        { type: "button", class: "small", onclick: () => this.#lead(body) },
        "Show the place",
      );
      card.append(go);
    }
    const safety = (body) => body.keys.yield_Pa / body.keys.places[0].value_Pa || Infinity;
    this.showBody([...this.bodies].sort((a, b) => safety(a) - safety(b))[0]);
  }

  #lead(body) {
    this.showBody(body);
    this.stage.scrollIntoView({ behavior: isStill ? "auto" : "smooth" });
    this.select(body.keys.places[0]);
  }

  showBody(body) {
    const { state } = this;
    state.body = body;
    state.field = null;
    this.fieldChoice.replaceChildren(
      ...["von Mises stress", ...body.fields.map((field) => field.name)].map((name, i) =>
        element("option", { value: i }, name),
      ),
    );
    this.view.prepare(body);
    this.places.show(body);
    press(this.bodyChoice, body.name);
    this.camera.depth = body.surface.size * 2;
    Object.assign(this.camera, this.home());
    state.instant = body.keys.places[0].instant;
    this.combine();
    this.select(body.keys.places[0], false);
    this.showMode(state.mode);
  }

  /* A field of the run itself, largest over the cycle with all effects; null: von Mises stress. */
  showField(field) {
    this.state.field = field;
    if (field) this.showMode("largest", field);
    else this.render();
  }

  showMode(mode, field = null) {
    this.state.mode = mode;
    this.state.field = field;
    this.fieldChoice.value = this.state.body.fields.indexOf(field) + 1;
    press(this.modeChoice, mode);
    this.render();
    if (mode === "largest") this.findLargest();
  }

  select(place, isFlown = true) {
    this.state.place = place;
    this.places.mark(place);
    if (isFlown) {
      const { surface } = this.state.body;
      const normal = surface.normalAt(place.at_m);
      const isLong = surface.high[2] - surface.low[2] > 2 * (surface.high[1] - surface.low[1]);
      this.fly({
        yaw: isLong ? besideAxis(normal, 0.9) : Math.atan2(normal[0], normal[2]) + 0.35,
        pitch: Math.max(-1, Math.min(1, Math.asin(normal[1]) * 0.8 + 0.15)),
        at: [...place.at_m],
        half: surface.size * 0.13,
      });
    }
    this.drawCourse();
    this.render();
  }

  drawCourse() {
    const { body, place } = this.state;
    const toMegapascals = (course) => course.map((v) => v / 1e6);
    const own = toMegapascals(body.course(place.row));
    this.course.series = [{ values: own, ink: "accent", label: "" }];
    if (this.effects.off.size) {
      this.course.series[0].label = "without what is off";
      this.course.series.unshift({
        values: toMegapascals(body.course(place.row, body.whole.stress)),
        ink: "soft",
        dash: [5, 4],
        label: "with all effects",
      });
    }
    const at = own.reduce((best, v, t) => (v > own[best] ? t : best), 0);
    this.courseTitle.textContent = `${readable(place.name) || "The body"}: largest ${digits(own[at])} MPa, ${this.cycle.moment(at)}`;
    this.course.chosen = this.state.instant;
    this.course.draw();
  }

  setInstant(t, isShown = true) {
    this.state.instant = t;
    if (this.slider) {
      this.slider.value = t;
      this.moment.textContent = `${this.cycle.moment(t)}, ${digits(this.cycle.time[t])} s`;
      this.slider.setAttribute("aria-valuetext", this.moment.textContent);
      if (isShown && this.state.mode !== "now") this.showMode("now");
    }
    if (this.course) this.course.chosen = t;
    if (this.loads) this.loads.choose(t);
    this.redraw();
  }

  magnify(share) {
    this.state.magnified = share / 100;
    if (share && this.state.mode !== "now") this.showMode("now");
    this.render();
  }

  combine() {
    const { body } = this.state;
    body.combine(this.effects.chosen.chosen);
    if (this.diagrams) this.diagrams.draw(this.state.instant, true);
  }

  effectsChanged() {
    if (this.state.field) this.showField(null);
    this.combine();
    this.drawCourse();
    this.render();
    if (this.state.mode === "largest") this.findLargest();
  }

  get key() {
    return `${this.state.body.name}|${[...this.effects.off].sort().join()}`;
  }

  /* Largest over the cycle for the effects that are on. With all of them it is the run's own envelope. */
  async findLargest() {
    const { body } = this.state;
    const key = this.key;
    if (!this.largest.has(key)) {
      const mine = ++this.job;
      const pause = async (share) => {
        this.progress.hidden = false;
        this.progress.value = share;
        await new Promise((resume) => setTimeout(resume));
        return mine === this.job;
      };
      const field =
        this.effects.off.size === 0 ? this.#envelope(body) : await this.#searchLargest(body, pause);
      if (!field) return;
      this.progress.hidden = true;
      this.largest.set(key, field);
    }
    this.render();
  }

  #envelope(body) {
    const field = new Float32Array(body.rows);
    field.set(body.envelope);
    for (const place of body.keys.places) field[place.row] = place.value_Pa;
    return field;
  }

  /* By the graphics card; where there is none the script is faster. */
  async #searchLargest(body, pause) {
    if (!this.view.isSoftware) return this.view.largest(body, pause);
    const field = new Float32Array(body.rows);
    const perTurn = this.cycle.per_turn || this.cycle.n;
    const stride = Math.max(1, Math.floor(perTurn / 30));
    let begun = performance.now();
    for (let row = 0; row < body.rows; row++) {
      field[row] = row < body.n && body.excluded[row] ? 0 : body.largestOver(row, stride);
      if (performance.now() - begun < 25) continue;
      if (!(await pause(row / body.rows))) return null;
      begun = performance.now();
    }
    return field;
  }

  shownField() {
    const { body, mode, instant, field } = this.state;
    if (field) return field.values;
    if (mode === "now") return this.view.field(body, instant);
    return this.largest.get(this.key) || null;
  }

  /* ---- Drawing ---- */

  render() {
    if (!this.view || this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.draw();
    });
  }

  redraw() {
    for (const chart of charts) chart.draw();
    if (this.diagrams) this.diagrams.draw(this.state.instant, false);
    this.render();
  }

  draw() {
    const { body, mode, instant } = this.state;
    const begun = performance.now();
    const field = this.shownField();
    const own = this.state.field;
    const top = (own ? own.top : body.keys.peak_Pa) || 1;
    const step = roundStep(top, 6);
    if (mode !== "now") this.view.show(body, field || new Float32Array(body.rows));
    const magnified = mode === "now" ? this.magnification() : 0;
    this.view.draw(body, {
      instant: mode === "now" ? instant : null,
      matrix: this.camera.matrix(),
      top,
      magnified,
      isGroup: own && own.groups,
      step: this.ticks.lines.checked ? step : 0,
      mesh: this.ticks.mesh.checked,
    });
    this.field = field;
    this.magnified.textContent = magnified ? `× ${digits(magnified, 2)}` : "off";
    this.overlay.draw(field, top, step);
    this.lastFrame = performance.now() - begun;
  }

  magnification() {
    const { body, magnified } = this.state;
    return (magnified * 0.12 * body.surface.size) / (body.keys.largest_displacement_m || 1);
  }

  /* ---- Moving about ---- */

  home() {
    const { surface, keys } = this.state.body;
    const normal = surface.normalAt(keys.places[0].at_m);
    const isLong =
      surface.high[2] - surface.low[2] >
      2 * Math.max(surface.high[0] - surface.low[0], surface.high[1] - surface.low[1]);
    return isLong
      ? this.camera.whole(surface, besideAxis(normal, 1.1), 0.3)
      : this.camera.whole(surface, Math.atan2(normal[0], normal[2]) + 0.45, 0.25);
  }

  fly(to, milliseconds = isStill ? 0 : 600) {
    const from = { ...this.camera, at: [...this.camera.at] };
    const begun = performance.now();
    const flight = (this.flight = {});
    const turn =
      to.yaw === undefined ? 0 : Math.atan2(Math.sin(to.yaw - from.yaw), Math.cos(to.yaw - from.yaw));
    const move = (now) => {
      if (flight !== this.flight) return;
      const share = milliseconds ? Math.min(1, (now - begun) / milliseconds) : 1;
      const eased = share * share * (3 - 2 * share);
      this.camera.yaw = from.yaw + turn * eased;
      this.camera.pitch = from.pitch + ((to.pitch ?? from.pitch) - from.pitch) * eased;
      this.camera.half = from.half * (to.half / from.half) ** eased;
      this.camera.at = from.at.map((v, d) => v + (to.at[d] - v) * eased);
      this.draw();
      if (share < 1) requestAnimationFrame(move);
    };
    if (milliseconds) requestAnimationFrame(move);
    else move(begun);
  }

  play() {
    const { state } = this;
    state.isPlaying = !state.isPlaying;
    this.player.textContent = state.isPlaying ? "Pause" : "Play";
    this.player.setAttribute("aria-pressed", String(state.isPlaying));
    let last = performance.now();
    const next = (now) => {
      if (!state.isPlaying) return;
      const perTurn = this.cycle.per_turn || this.cycle.n;
      const steps = Math.max(1, Math.round(((now - last) / 4000) * perTurn));
      last = now;
      this.setInstant((state.instant + steps) % this.cycle.n);
      requestAnimationFrame(next);
    };
    if (state.isPlaying) requestAnimationFrame(next);
  }
}

/* The side from which a long body is seen: that of the normal, at an angle to its axis. */
function besideAxis(normal, angle) {
  return (normal[0] < 0 ? -1 : 1) * (normal[2] < 0 ? Math.PI - angle : angle);
}

/* Pictures in the place of the bodies; all tables stay. */
function standStill(why) {
  document.documentElement.classList.remove("live");
  const holder = find("living");
  holder.replaceChildren(
    element("p", { class: "warning" }, `The bodies stand still: ${why} All figures and tables are below.`),
  );
}

async function open() {
  const keys = JSON.parse(find("living-keys").textContent);
  const page = new Page(keys, await Sections.unpack(find("living-data").textContent, keys.index));
  document.documentElement.classList.add("live");
  page.build(find("living"));
  window.millstress = page;
}

open().catch((error) => {
  standStill(`this browser cannot draw them (${error.message}).`);
  window.millstressFailed = error;
});
