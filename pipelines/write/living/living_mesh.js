/* Triangles of a body's surface. Nine-node faces that are curved become a lattice of 4 x 4 pieces, so that
   round bodies stay round; a point between nodes lies on the biquadratic face and has the mean of its nodes. */

const halves = { 4: [0, 1, 2, 3], 3: [0, 1, 2, 2] };
/* Lattice of the nodes of a nine-node face, and its rim; pieces of a six-node face. */
const nine = [
  [0, 4, 1],
  [7, 8, 5],
  [3, 6, 2],
];
const six = [
  [0, 3, 5],
  [3, 1, 4],
  [5, 4, 2],
  [3, 4, 5],
];
const rims = { 3: [0, 1, 2], 4: [0, 1, 2, 3], 6: [0, 3, 1, 4, 2, 5], 9: [0, 4, 1, 5, 2, 6, 3, 7] };

class Surface {
  constructor(body) {
    this.body = body;
    this.positions = Array.from(body.points);
    this.parents = []; /* of points that are no nodes: the nodes whose mean they have */
    this.between = new Map();
    this.triangles = [];
    this.rim = [];
    const { faces, nodes_per_face, doubled_faces } = body.keys;
    for (let f = 0; f < faces; f++) {
      const nodes = Array.from(body.faces.subarray(f * nodes_per_face, (f + 1) * nodes_per_face));
      this.#face(nodes, false);
      if (f < doubled_faces)
        this.#face(
          nodes.map((i) => (i < body.n ? i + body.n : i)),
          true,
        );
    }
    this.#shade();
  }

  #triangle(a, b, c, isFlipped) {
    if (isFlipped) this.triangles.push(a, c, b);
    else this.triangles.push(a, b, c);
  }

  #quad([a, b, c, d], isFlipped) {
    if (c === d) return this.#triangle(a, b, c, isFlipped);
    if (this.#distance(a, c) <= this.#distance(b, d) * 1.0001) {
      this.#triangle(a, b, c, isFlipped);
      this.#triangle(a, c, d, isFlipped);
    } else {
      this.#triangle(a, b, d, isFlipped);
      this.#triangle(b, c, d, isFlipped);
    }
  }

  #distance(a, b) {
    const p = this.positions;
    return Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]);
  }

  /* Whether the middle of an edge lies beside the line between its ends. */
  #isBent(a, middle, b) {
    const p = this.positions;
    let beside = 0;
    for (let d = 0; d < 3; d++) beside += (p[3 * middle + d] - (p[3 * a + d] + p[3 * b + d]) / 2) ** 2;
    return Math.sqrt(beside) > 0.02 * this.#distance(a, b);
  }

  #face(nodes, isFlipped) {
    const count = nodes.length;
    if (count === 9) this.#nine(nodes, isFlipped);
    else if (count === 6)
      for (const [a, b, c] of six) this.#triangle(nodes[a], nodes[b], nodes[c], isFlipped);
    else
      this.#quad(
        halves[count].map((i) => nodes[i]),
        isFlipped,
      );
    if (count === 9 && this.curved) return;
    const rim = rims[count].map((i) => nodes[i]);
    rim.forEach((node, i) => this.rim.push(node, rim[(i + 1) % rim.length]));
  }

  #nine(nodes, isFlipped) {
    const edges = [
      [0, 4, 1],
      [1, 5, 2],
      [2, 6, 3],
      [3, 7, 0],
    ];
    this.curved = edges.some(([a, middle, b]) => this.#isBent(nodes[a], nodes[middle], nodes[b]));
    if (!this.curved) {
      const at = (i, j) => nodes[nine[j][i]];
      for (let j = 0; j < 2; j++)
        for (let i = 0; i < 2; i++)
          this.#quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], isFlipped);
      return;
    }
    const lattice = [];
    for (let j = 0; j < 5; j++) for (let i = 0; i < 5; i++) lattice.push(this.#point(nodes, i, j));
    for (let j = 0; j < 4; j++)
      for (let i = 0; i < 4; i++) {
        const a = 5 * j + i;
        this.#quad([lattice[a], lattice[a + 1], lattice[a + 6], lattice[a + 5]], isFlipped);
      }
    const ring = [0, 1, 2, 3, 4, 9, 14, 19, 24, 23, 22, 21, 20, 15, 10, 5].map((i) => lattice[i]);
    ring.forEach((point, i) => this.rim.push(point, ring[(i + 1) % ring.length]));
  }

  /* A point of the lattice: a node, or one between two or four of them. Those on an edge belong to both its
     faces. */
  #point(nodes, i, j) {
    if (i % 2 === 0 && j % 2 === 0) return nodes[nine[j / 2][i / 2]];
    const columns = i % 2 ? [(i - 1) / 2, (i + 1) / 2] : [i / 2];
    const rows = j % 2 ? [(j - 1) / 2, (j + 1) / 2] : [j / 2];
    const parents = rows.flatMap((row) => columns.map((column) => nodes[nine[row][column]]));
    const isOnEdge = parents.length === 2 && (i === 0 || i === 4 || j === 0 || j === 4);
    const key = isOnEdge ? Math.min(...parents) * 4194304 + Math.max(...parents) : -1;
    if (isOnEdge && this.between.has(key)) return this.between.get(key);
    const shape = (t) => [(t * (t - 1)) / 2, 1 - t * t, (t * (t + 1)) / 2];
    const [along, across] = [shape(i / 2 - 1), shape(j / 2 - 1)];
    const made = this.positions.length / 3;
    for (let d = 0; d < 3; d++) {
      let x = 0;
      for (let row = 0; row < 3; row++)
        for (let column = 0; column < 3; column++)
          x += along[column] * across[row] * this.positions[3 * nodes[nine[row][column]] + d];
      this.positions.push(x);
    }
    this.parents.push(parents);
    if (isOnEdge) this.between.set(key, made);
    return made;
  }

  /* Nodes whose mean a point has: one, two or four. */
  nodesOf(point) {
    const own = this.body.points.length / 3;
    return point < own ? [point] : this.parents[point - own];
  }

  /* Normals, one point for each side of a sharp edge, and the sharp edges. */
  #shade() {
    const p = this.positions;
    const triangles = Uint32Array.from(this.triangles);
    const count = triangles.length / 3;
    const normals = new Float32Array(3 * count);
    const areas = new Float32Array(count);
    let volume = 0;
    for (let t = 0; t < count; t++) {
      const [a, b, c] = [3 * triangles[3 * t], 3 * triangles[3 * t + 1], 3 * triangles[3 * t + 2]];
      const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
      const w = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      const m = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
      volume += p[a] * m[0] + p[a + 1] * m[1] + p[a + 2] * m[2];
      areas[t] = Math.hypot(...m) || 1e-30;
      for (let d = 0; d < 3; d++) normals[3 * t + d] = m[d] / areas[t];
    }
    if (volume < 0) for (let i = 0; i < normals.length; i++) normals[i] *= -1;
    const cosine = (s, t) =>
      normals[3 * s] * normals[3 * t] +
      normals[3 * s + 1] * normals[3 * t + 1] +
      normals[3 * s + 2] * normals[3 * t + 2];

    const points = p.length / 3;
    const first = new Uint32Array(points + 1);
    for (const point of triangles) first[point + 1]++;
    for (let i = 0; i < points; i++) first[i + 1] += first[i];
    const around = new Uint32Array(triangles.length);
    const filled = first.slice();
    triangles.forEach((point, corner) => (around[filled[point]++] = (corner / 3) | 0));

    const smooth = Math.cos((40 * Math.PI) / 180);
    const corners = new Uint32Array(triangles.length);
    const known = Array.from({ length: points }, () => null);
    const made = { position: [], normal: [], owner: [] };
    for (let corner = 0; corner < triangles.length; corner++) {
      const own = (corner / 3) | 0;
      const point = triangles[corner];
      const sum = [0, 0, 0];
      for (let k = first[point]; k < first[point + 1]; k++) {
        const other = around[k];
        if (cosine(own, other) > smooth)
          for (let d = 0; d < 3; d++) sum[d] += areas[other] * normals[3 * other + d];
      }
      const length = Math.hypot(...sum) || 1;
      const packed = sum.map((s) => Math.round((127 * s) / length));
      known[point] ||= [];
      let at = known[point].find((v) =>
        packed.every((value, d) => Math.abs(value - made.normal[4 * v + d]) < 4),
      );
      if (at === undefined) {
        at = made.owner.length;
        known[point].push(at);
        made.position.push(p[3 * point], p[3 * point + 1], p[3 * point + 2]);
        made.normal.push(...packed, 0);
        made.owner.push(point);
      }
      corners[corner] = at;
    }
    const sharp = [];
    const edges = new Map();
    const crease = Math.cos((30 * Math.PI) / 180);
    for (let corner = 0; corner < triangles.length; corner++) {
      const t = (corner / 3) | 0;
      const [a, b] = [triangles[corner], triangles[3 * t + ((corner + 1) % 3)]];
      const key = a < b ? a * 4194304 + b : b * 4194304 + a;
      const other = edges.get(key);
      if (other === undefined) edges.set(key, t);
      else if (cosine(other, t) < crease) sharp.push(known[a][0], known[b][0]);
    }
    const nodes = new Uint32Array(4 * made.owner.length);
    made.owner.forEach((point, v) => {
      const own = this.nodesOf(point);
      for (let k = 0; k < 4; k++) nodes[4 * v + k] = own[(k * own.length) >> 2];
    });
    this.vertices = {
      position: Float32Array.from(made.position),
      normal: Int8Array.from(made.normal),
      nodes,
      triangles: corners,
      sharp: Uint32Array.from(sharp),
      rim: Uint32Array.from(this.rim, (point) => known[point][0]),
    };
    this.corners = triangles;
    this.known = known;
    this.low = [Infinity, Infinity, Infinity];
    this.high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < made.position.length; i++) {
      this.low[i % 3] = Math.min(this.low[i % 3], made.position[i]);
      this.high[i % 3] = Math.max(this.high[i % 3], made.position[i]);
    }
    this.size = Math.hypot(...this.high.map((h, d) => h - this.low[d]));
  }

  /* Normal of the surface at the node next to a place. */
  normalAt(place) {
    const p = this.positions;
    let nearest = 0;
    let least = Infinity;
    for (let i = 0; i < this.body.points.length / 3; i++) {
      if (!this.known[i]) continue;
      const distance =
        (p[3 * i] - place[0]) ** 2 + (p[3 * i + 1] - place[1]) ** 2 + (p[3 * i + 2] - place[2]) ** 2;
      if (distance < least) [least, nearest] = [distance, i];
    }
    const sum = [0, 0, 0];
    for (const v of this.known[nearest] || [])
      for (let d = 0; d < 3; d++) sum[d] += this.vertices.normal[4 * v + d];
    const length = Math.hypot(...sum) || 1;
    return sum.map((s) => s / length);
  }
}
