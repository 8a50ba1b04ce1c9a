/* A body: the factors of its modes for any set of effects, and the stress of its points. */

class Body {
  constructor(keys, sections, cycle, toggles) {
    this.keys = keys;
    this.name = keys.name;
    this.cycle = cycle;
    const own = (name) => sections.get(`${keys.name}/${name}`);
    this.n = keys.nodes;
    this.rows = keys.nodes + keys.places.length;
    this.mirrored = keys.mirror_axis >= 0;
    this.points = this.#points(own("xyz"));
    this.excluded = own("excluded");
    this.envelope = sections.range(`${keys.name}/envelope`, keys.envelope_Pa);
    this.fields = this.#fields(sections);
    this.faces = own("faces");
    this.stress = this.#modes("stress", own, 5, this.rows);
    this.displacement = this.#modes("displacement", own, 3, this.n);
    this.basis = own("basis");
    this.tables = own("tables");
    if (keys.sections) this.sectionResultants = own("sections");
    /* Tables of loads: of all effects first, then of what each toggle changes. */
    this.table = new Map();
    let number = 1;
    for (const toggle of toggles) if (toggle.has_table) this.table.set(toggle, number++);
    this.combine([]);
    this.whole = { stress: this.stress.factors, channels: this.channelFactors };
  }

  /* Fields of the run that are not put together anew: numbers, and the effects that lead. */
  #fields(sections) {
    const { keys } = this;
    const padded = (values) => {
      const whole = new Float32Array(this.rows);
      whole.set(values);
      return whole;
    };
    const fields = keys.fields.map(({ name, unit, range }) => {
      const values = padded(sections.range(`${keys.name}/${name}`, range));
      const top = values.reduce((most, v, i) => (i < this.n && !this.excluded[i] && v > most ? v : most), 0);
      return { name, unit, values, top };
    });
    if (keys.leading_groups)
      fields.push({
        name: "effects that lead",
        values: padded(sections.get(`${keys.name}/leading group`)),
        groups: keys.leading_groups,
      });
    return fields;
  }

  /* Nodes, and behind them their images. */
  #points(xyz) {
    const { n, mirrored } = this;
    const points = new Float32Array(3 * n * (mirrored ? 2 : 1));
    for (let i = 0; i < n; i++)
      for (let d = 0; d < 3; d++) {
        const x = xyz[d * n + i];
        points[3 * i + d] = x;
        if (mirrored)
          points[3 * (n + i) + d] = d === this.keys.mirror_axis ? 2 * this.keys.mirror_at_m - x : x;
      }
    return points;
  }

  /* Modes of a point together, padded to fours for the texels that they become. */
  #modes(name, own, components, rows) {
    const { rank, steps } = this.keys[name];
    const padded = Math.max(4, Math.ceil(rank / 4) * 4);
    const stored = own(name);
    const values = new Int16Array(rows * components * padded);
    for (let c = 0; c < components; c++)
      for (let m = 0; m < rank; m++)
        for (let i = 0, from = (c * rank + m) * rows; i < rows; i++)
          values[(i * components + c) * padded + m] = stored[from + i];
    return {
      rank,
      steps,
      components,
      padded,
      values,
      rows,
      projection: own(`${name} factors`),
      factors: null,
    };
  }

  /* Factors at all instants without what the toggles switch off. Channels follow from signals; the harmonics
     of a seat's pressure turn with the force that is left. */
  combine(toggles) {
    const { keys, basis, tables, cycle } = this;
    const n = cycle.n;
    const rank = keys.time_rank;
    const size = keys.n_signals * rank;
    const table = Float64Array.from(tables.subarray(0, size));
    for (const toggle of toggles) {
      const from = this.table.get(toggle) * size;
      for (let i = 0; i < size; i++) table[i] -= tables[from + i];
    }
    const signals = new Float64Array(keys.n_signals * n);
    for (let s = 0; s < keys.n_signals; s++)
      for (let k = 0; k < rank; k++) {
        const weight = table[s * rank + k];
        if (weight === 0) continue;
        for (let t = 0, at = s * n, from = k * n; t < n; t++) signals[at + t] += weight * basis[from + t];
      }
    const K = keys.channels.length;
    const channels = new Float64Array(K * n);
    keys.signals.forEach((channel, s) => channels.set(signals.subarray(s * n, (s + 1) * n), channel * n));
    for (const [channel, force, harmonic, isSine, factor] of keys.laws)
      for (let t = 0; t < n; t++) {
        const x = signals[force * n + t];
        const y = signals[(force + 1) * n + t];
        const angle = harmonic * Math.atan2(y, x);
        channels[channel * n + t] = factor * Math.hypot(x, y) * (isSine ? Math.sin(angle) : Math.cos(angle));
      }
    this.channelFactors = channels;
    for (const modes of [this.stress, this.displacement]) modes.factors = this.#project(modes, channels, K);
  }

  #project(modes, channels, K) {
    const n = this.cycle.n;
    const factors = new Float32Array(n * modes.padded);
    for (let m = 0; m < modes.rank; m++)
      for (let k = 0; k < K; k++) {
        const weight = modes.projection[m * K + k] * modes.steps[m];
        if (weight === 0) continue;
        for (let t = 0; t < n; t++) factors[t * modes.padded + m] += weight * channels[k * n + t];
      }
    return factors;
  }

  /* Von Mises stress of a row at an instant [Pa]: the length of five numbers. */
  vonMises(row, t, factors = this.stress.factors) {
    const { values, padded, rank } = this.stress;
    let square = 0;
    for (let c = 0, at = row * 5 * padded; c < 5; c++, at += padded) {
      let sum = 0;
      for (let m = 0, own = t * padded; m < rank; m++) sum += values[at + m] * factors[own + m];
      square += sum * sum;
    }
    return Math.sqrt(square);
  }

  course(row, factors = this.stress.factors) {
    return Float32Array.from({ length: this.cycle.n }, (_, t) => this.vonMises(row, t, factors));
  }

  field(t) {
    return Float32Array.from({ length: this.rows }, (_, row) => this.vonMises(row, t));
  }

  /* Node of the largest value that is not left out beside a sharp edge. */
  largest(field) {
    let node = 0;
    let value = -1;
    for (let i = 0; i < this.n; i++)
      if (!this.excluded[i] && field[i] > value) {
        value = field[i];
        node = i;
      }
    return { node, value };
  }

  /* What the body is judged by: the largest of its nodes, or of its weld toes where one of them governs. */
  judged(field) {
    const peak = this.largest(field);
    const governing = this.keys.places[0];
    const candidates = this.keys.places.filter((place) => place.kind === "toe" || place.kind === "governing");
    if (!candidates.some((place) => place.kind === "toe" && place.name === governing.name))
      return { value: peak.value, at: this.positionOf(peak.node), name: "" };
    const best = candidates.reduce((a, b) => (field[b.row] > field[a.row] ? b : a));
    return { value: field[best.row], at: best.at_m, name: best.name };
  }

  /* Largest over the cycle of one row: every fourth instant, then those beside the ones that come close. */
  largestOver(row, stride) {
    const n = this.cycle.n;
    let best = 0;
    const coarse = [];
    for (let t = 0; t < n; t += stride) {
      const value = this.vonMises(row, t);
      coarse.push(value);
      best = Math.max(best, value);
    }
    if (stride === 1) return best;
    const near = 0.93 * best;
    for (let k = 0; k < coarse.length; k++)
      if (coarse[k] >= near)
        for (let t = Math.max(0, (k - 1) * stride + 1); t < Math.min(n, (k + 1) * stride); t++)
          if (t % stride) best = Math.max(best, this.vonMises(row, t));
    return best;
  }

  positionOf(node) {
    return [0, 1, 2].map((d) => this.points[3 * node + d]);
  }

  /* Displacement of a node, or of an image, at an instant [m]. */
  moved(node, t) {
    const { values, padded, rank, factors } = this.displacement;
    const own = node % this.n;
    return [0, 1, 2].map((d) => {
      let sum = 0;
      for (let m = 0, at = (own * 3 + d) * padded; m < rank; m++)
        sum += values[at + m] * factors[t * padded + m];
      return node >= this.n && d === this.keys.mirror_axis ? -sum : sum;
    });
  }

  /* Force of an arrow at an instant [N]. */
  force(arrow, t) {
    const n = this.cycle.n;
    return [this.channelFactors[arrow.x * n + t], this.channelFactors[arrow.y * n + t]];
  }

  /* Internal resultants of a section plane at an instant: fx, fy, fz [N], mx, my, mz [N m]. */
  resultants(plane, t) {
    const K = this.keys.channels.length;
    const n = this.cycle.n;
    const sum = [0, 0, 0, 0, 0, 0];
    for (let k = 0; k < K; k++) {
      const factor = this.channelFactors[k * n + t];
      for (let c = 0, at = (plane * K + k) * 6; c < 6; c++) sum[c] += factor * this.sectionResultants[at + c];
    }
    return sum;
  }
}

/* Which toggles together switch off the effects: the largest first. What is left has no loads of its own. */
function togglesFor(toggles, off) {
  const left = new Set(off);
  const chosen = [];
  const fitting = toggles.filter(
    (toggle) => toggle.has_table && toggle.off.every((effect) => left.has(effect)),
  );
  for (const toggle of fitting.sort((a, b) => b.off.length - a.off.length))
    if (toggle.off.every((effect) => left.has(effect))) {
      chosen.push(toggle);
      toggle.off.forEach((effect) => left.delete(effect));
    }
  return { chosen, isExact: chosen.length <= 1 && left.size === 0 };
}
