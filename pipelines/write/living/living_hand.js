/* Mouse, fingers and keys on the body. */

class Hand {
  constructor(page) {
    this.page = page;
    this.#listen();
  }

  #listen() {
    const { canvas, camera } = this.page;
    const pointers = new Map();
    let spread = 0;
    const leave = (event) => {
      pointers.delete(event.pointerId);
      spread = 0;
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, event);
      this.page.flight = null;
      this.page.tip.hidden = true;
    });
    canvas.addEventListener("pointerup", leave);
    canvas.addEventListener("pointercancel", leave);
    canvas.addEventListener("pointerleave", () => (this.page.tip.hidden = true));
    canvas.addEventListener("pointermove", (event) => {
      const old = pointers.get(event.pointerId);
      if (!old) return this.#hover(event);
      const [dx, dy] = [event.clientX - old.clientX, event.clientY - old.clientY];
      pointers.set(event.pointerId, event);
      if (pointers.size === 2) {
        const [a, b] = [...pointers.values()];
        const apart = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
        if (spread) camera.half *= spread / apart;
        spread = apart;
        camera.slide(dx / 2, dy / 2);
      } else if (event.shiftKey || event.buttons & 6) camera.slide(dx, dy);
      else this.#turn(-0.008 * dx, 0.008 * dy);
      this.page.render();
    });
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.page.flight = null;
        camera.half *= Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * 0.004);
        this.page.render();
      },
      { passive: false },
    );
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("dblclick", (event) => this.#choosePoint(event));
    canvas.addEventListener("keydown", (event) => this.#key(event));
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      standStill("The browser has lost its graphics; load the page again.");
    });
  }

  #turn(yaw, pitch) {
    this.page.camera.yaw += yaw;
    this.page.camera.pitch = Math.max(-1.57, Math.min(1.57, this.page.camera.pitch + pitch));
  }

  #key(event) {
    const { camera, state, cycle } = this.page;
    const keys = {
      ArrowLeft: () => this.#turn(0.1, 0),
      ArrowRight: () => this.#turn(-0.1, 0),
      ArrowUp: () => this.#turn(0, 0.1),
      ArrowDown: () => this.#turn(0, -0.1),
      "+": () => (camera.half /= 1.15),
      "=": () => (camera.half /= 1.15),
      "-": () => (camera.half *= 1.15),
      f: () => this.page.fly(this.page.home()),
      F: () => this.page.fly(this.page.home()),
      " ": () => this.page.play(),
      "[": () => this.page.setInstant((state.instant + cycle.n - 1) % cycle.n),
      "]": () => this.page.setInstant((state.instant + 1) % cycle.n),
    };
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
    this.page.render();
  }

  /* The point of the surface under the pointer: the nearest triangle there. */
  #hit(event) {
    const { body } = this.page.state;
    const { surface } = body;
    const box = this.page.canvas.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    const p = surface.positions;
    const count = p.length / 3;
    const seen = new Float32Array(3 * count);
    for (let i = 0; i < count; i++) {
      const [x, y, z] = this.page.camera.project([p[3 * i], p[3 * i + 1], p[3 * i + 2]]);
      seen[3 * i] = x - px;
      seen[3 * i + 1] = y - py;
      seen[3 * i + 2] = z;
    }
    let best = null;
    const { corners } = surface;
    for (let t = 0; t < corners.length; t += 3) {
      const [a, b, c] = [3 * corners[t], 3 * corners[t + 1], 3 * corners[t + 2]];
      const A = seen[b] * seen[c + 1] - seen[c] * seen[b + 1];
      const B = seen[c] * seen[a + 1] - seen[a] * seen[c + 1];
      const C = seen[a] * seen[b + 1] - seen[b] * seen[a + 1];
      if (!((A >= 0 && B >= 0 && C >= 0) || (A <= 0 && B <= 0 && C <= 0)) || A + B + C === 0) continue;
      const weights = [A, B, C].map((area) => area / (A + B + C));
      const near = weights[0] * seen[a + 2] + weights[1] * seen[b + 2] + weights[2] * seen[c + 2];
      if (!best || near > best.near)
        best = { near, weights, points: [corners[t], corners[t + 1], corners[t + 2]] };
    }
    return best;
  }

  #valueOf(point) {
    const { body } = this.page.state;
    const nodes = body.surface.nodesOf(point).map((node) => node % body.n);
    return {
      value: nodes.reduce((sum, node) => sum + this.page.field[node], 0) / nodes.length,
      isOut: nodes.some((node) => body.excluded[node]),
    };
  }

  #text(value) {
    const { field } = this.page.state;
    if (!field || field.unit === "Pa") return `${megapascals(value)} MPa`;
    return field.groups ? readable(field.groups[Math.round(value)]) : digits(value);
  }

  #hover(event) {
    if (event.pointerType === "touch" || !this.page.field || this.isHovering) return;
    this.isHovering = true;
    requestAnimationFrame(() => {
      this.isHovering = false;
      const hit = this.#hit(event);
      this.page.tip.hidden = !hit;
      if (!hit) return;
      const found = hit.points.map((point) => this.#valueOf(point));
      const value = found.reduce((sum, own, i) => sum + own.value * hit.weights[i], 0);
      this.page.tip.textContent = found.some((own) => own.isOut)
        ? "beside a sharp edge: no stress is stated"
        : this.#text(value);
      const box = this.page.canvas.getBoundingClientRect();
      this.page.tip.style.left = `${Math.min(box.width - this.page.tip.offsetWidth - 4, event.clientX - box.left + 14)}px`;
      this.page.tip.style.top = `${event.clientY - box.top + 14}px`;
    });
  }

  #choosePoint(event) {
    const hit = this.#hit(event);
    if (!hit) return;
    const { body } = this.page.state;
    const point = hit.points[hit.weights.indexOf(Math.max(...hit.weights))];
    const node = body.surface.nodesOf(point)[0];
    const at_m = body.positionOf(node);
    this.page.select(
      {
        kind: "point",
        name: `(${at_m.map((v) => (1000 * v).toFixed(1)).join(", ")}) mm`,
        at_m,
        row: node % body.n,
        note: "",
      },
      false,
    );
  }
}
