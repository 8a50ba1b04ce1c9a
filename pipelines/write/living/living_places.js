/* The side of the stage: places to go to, effects to take away. */

class Places {
  constructor(select) {
    this.select = select;
    this.holder = element("div", { class: "pane", id: "places" });
  }

  show(body) {
    this.buttons = [];
    this.holder.replaceChildren();
    const titles = [
      ["governing", "Governs"],
      ["toe", "Weld toes, hot-spot stress"],
      ["zone", `Zones above ${megapascals(body.keys.zone_level_Pa)} MPa`],
    ];
    for (const [kind, title] of titles) {
      const places = body.keys.places.filter((place) => place.kind === kind);
      if (!places.length) continue;
      this.holder.append(element("h3", {}, title));
      for (const place of places) this.#add(body, place);
    }
  }

  #add(body, place) {
    const error = place.error_Pa === null ? "" : ` ± ${megapascals(place.error_Pa)}`;
    const safety = body.keys.yield_Pa > 0 ? `, safety ${digits(body.keys.yield_Pa / place.value_Pa, 3)}` : "";
    const button = element(
      "button",
      { type: "button", class: "place", "aria-pressed": "false", onclick: () => this.select(place) },
      element("b", {}, readable(place.name) || "the body"),
      element("span", {}, `${megapascals(place.value_Pa)}${error} MPa`),
      element("small", {}, `${place.note}${safety}`),
    );
    this.buttons.push([place, button]);
    this.holder.append(button);
  }

  mark(place) {
    for (const [own, button] of this.buttons) button.setAttribute("aria-pressed", String(own === place));
  }
}

class Effects {
  /* @param changed  called after effects went or came back */
  constructor(keys, changed) {
    this.toggles = keys.toggles;
    this.groups = keys.effects.groups;
    this.meanings = new Map(keys.effects.on.map((effect) => [effect.name, effect.meaning]));
    this.changed = changed;
    this.off = new Set();
    this.note = element("p", { class: "note", role: "status" });
    this.holder = element("div", { class: "pane", id: "effects" });
    this.boxes = [];
    this.#fill();
    this.#tell();
  }

  get chosen() {
    return togglesFor(this.toggles, this.off);
  }

  #fill() {
    this.holder.append(
      element("button", { type: "button", class: "small", onclick: () => this.#set(new Set()) }, "All on"),
      this.note,
    );
    for (const group of this.groups) {
      const own = this.toggles.find((toggle) => toggle.effects.length > 1 && toggle.name === group.name);
      const rows = group.effects.map((effect) =>
        this.#row(this.toggles.find((t) => t.effects.length === 1 && t.name === effect)),
      );
      if (!own) this.holder.append(...rows);
      else this.holder.append(this.#row(own, "group"), element("div", { class: "inner" }, ...rows));
    }
  }

  #row(toggle, kind = "effect") {
    const box = element("input", { type: "checkbox", onchange: () => this.#switch(toggle, box.checked) });
    this.boxes.push([toggle, box]);
    box.disabled = !toggle.has_table;
    const why = toggle.has_table ? toggle.why : `stays on: ${toggle.why}`;
    return element(
      "label",
      { class: kind, title: this.meanings.get(toggle.name) || "" },
      box,
      element("span", {}, readable(toggle.name)),
      ...(toggle.why ? [element("small", {}, why)] : []),
    );
  }

  #switch(toggle, isOn) {
    const off = new Set(this.off);
    if (!isOn) toggle.off.forEach((effect) => off.add(effect));
    /* What cannot be off without these comes back with them. */
    else
      for (const single of this.toggles)
        if (single.effects.length === 1 && single.off.some((effect) => toggle.effects.includes(effect)))
          off.delete(single.name);
    this.#set(off);
  }

  #set(off) {
    this.off = off;
    this.#tell();
    this.changed();
  }

  #tell() {
    for (const [toggle, box] of this.boxes) {
      const count = toggle.effects.filter((effect) => this.off.has(effect)).length;
      box.checked = count < toggle.effects.length;
      box.indeterminate = count > 0 && count < toggle.effects.length;
    }
    const { isExact } = this.chosen;
    this.note.textContent = !this.off.size
      ? "Take an effect away: the loads are those of a run without it, with all that follows from it, on this mesh."
      : isExact
        ? "As a run without it, on this mesh."
        : "Several are off: the changes that each makes are added up. A run may differ where one changes what another does.";
  }
}
