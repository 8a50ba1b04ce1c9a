/* The body in three dimensions. A first pass makes the field at all nodes of the instant's factors, a fragment
   a node; the second draws the surface with it. */

const fieldWidth = 256;

const headOf = (modes) => `#version 300 es
precision highp float; precision highp int; precision highp isampler2D; precision highp usampler2D;
#define TEXELS ${modes.padded / 4}
#define PARTS ${modes.components}
uniform isampler2D modes;
uniform int perLine, rows;
int row() { return int(gl_FragCoord.y) * ${fieldWidth} + int(gl_FragCoord.x); }
ivec2 place(int row) { return ivec2(row % perLine * PARTS * TEXELS, row / perLine); }
`;

/* The PARTS components of the field at a node. */
const fieldShader = (modes, result) => `${headOf(modes)}
uniform vec4 factors[TEXELS];
out uvec4 result;
void main() {
  if (row() >= rows) { result = uvec4(0u); return; }
  ivec2 at = place(row());
  float field[PARTS];
  for (int part = 0; part < PARTS; part++) {
    float sum = 0.;
    for (int k = 0; k < TEXELS; k++) sum += dot(vec4(texelFetch(modes, at + ivec2(part * TEXELS + k, 0), 0)), factors[k]);
    field[part] = sum;
  }
  ${result}
}`;
const length5 = `float square = 0.;
  for (int part = 0; part < PARTS; part++) square += field[part] * field[part];
  result = uvec4(floatBitsToUint(sqrt(square)), 0u, 0u, 0u);`;
const vector3 = `result = uvec4(floatBitsToUint(field[0]), floatBitsToUint(field[1]), floatBitsToUint(field[2]), 0u);`;

/* The largest length over all instants. */
const largestShader = (modes) => `${headOf(modes)}
uniform sampler2D course;
uniform int instants;
out uvec4 result;
void main() {
  if (row() >= rows) { result = uvec4(0u); return; }
  ivec2 at = place(row());
  vec4 own[PARTS * TEXELS];
  for (int k = 0; k < PARTS * TEXELS; k++) own[k] = vec4(texelFetch(modes, at + ivec2(k, 0), 0));
  float best = 0.;
  for (int t = 0; t < instants; t++) {
    float square = 0.;
    for (int part = 0; part < PARTS; part++) {
      float sum = 0.;
      for (int k = 0; k < TEXELS; k++) sum += dot(own[part * TEXELS + k], texelFetch(course, ivec2(t % 64 * TEXELS + k, t / 64), 0));
      square += sum * sum;
    }
    best = max(best, square);
  }
  result = uvec4(floatBitsToUint(sqrt(best)), 0u, 0u, 0u);
}`;

const wholeScreen = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4. - 1., 0, 1); }`;

const surfaceVertex = `#version 300 es
precision highp float; precision highp int; precision highp usampler2D;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uvec4 nodes;
uniform usampler2D field, moved, excluded;
uniform int count, mirrorAxis;
uniform float magnified, nearer;
uniform mat4 view;
out float value, left;
flat out float group; /* of one corner: between two groups lies no third */
out vec3 facing;
ivec2 place(int i) { return ivec2(i % ${fieldWidth}, i / ${fieldWidth}); }
void main() {
  value = 0.; left = 0.;
  vec3 p = position;
  for (int k = 0; k < 4; k++) {
    int node = int(nodes[k]);
    bool isImage = node >= count;
    if (isImage) node -= count;
    value += uintBitsToFloat(texelFetch(field, place(node), 0).r) / 4.;
    left = max(left, float(texelFetch(excluded, place(node), 0).r));
    if (magnified > 0.) {
      vec3 u = uintBitsToFloat(texelFetch(moved, place(node), 0).rgb);
      if (isImage) u[mirrorAxis] = -u[mirrorAxis];
      p += magnified * u / 4.;
    }
  }
  int corner = int(nodes[0]);
  group = uintBitsToFloat(texelFetch(field, place(corner >= count ? corner - count : corner), 0).r);
  facing = mat3(view) * normal;
  gl_Position = view * vec4(p, 1.);
  gl_Position.z -= nearer;
}`;

/* From light to dark, so that it reads without hue; shape shows at the light end. */
const colours = [
  "f4f1e4",
  "ffeda0",
  "fed976",
  "feb24c",
  "fd8d3c",
  "fc4e2a",
  "e31a1c",
  "bd0026",
  "7a0022",
].map((text) => [0, 2, 4].map((i) => parseInt(text.slice(i, i + 2), 16) / 255));

function colourOf(share) {
  const at = Math.min(Math.max(share, 0), 1) * (colours.length - 1);
  const i = Math.min(Math.floor(at), colours.length - 2);
  return colours[i].map((c, d) => c + (colours[i + 1][d] - c) * (at - i));
}

/* Of groups of effects: after Okabe and Ito, told apart by hatching too. */
const groupColours = ["56b4e9", "e69f00", "009e73", "f0e442", "cc79a7", "d55e00", "0072b2", "999999"];
const asVectors = (texts) =>
  texts
    .map((text) => [0, 2, 4].map((i) => (parseInt(text.slice(i, i + 2), 16) / 255).toFixed(4)))
    .map((c) => `vec3(${c.join()})`)
    .join();

const surfaceFragment = `#version 300 es
precision highp float;
in float value, left;
flat in float group;
in vec3 facing;
uniform float top, step_;
uniform vec4 line;
uniform bool isGroup;
out vec4 colour;
const vec3 groups[8] = vec3[](${asVectors(groupColours)});
const vec3 scale[${colours.length}] = vec3[](${colours.map((c) => `vec3(${c.map((v) => v.toFixed(4)).join()})`).join()});
void main() {
  if (line.a > 0.) { colour = line; return; }
  vec3 n = normalize(facing);
  float light = .74 + .3 * abs(n.z) + .1 * dot(n * sign(n.z), vec3(-.45, .7, -.3));
  vec3 base;
  if (left > .002) base = mix(vec3(.80), vec3(.58), step(.6, fract((gl_FragCoord.x + gl_FragCoord.y) / 8.)));
  else if (isGroup) {
    int i = int(group + .5);
    base = groups[i % 8];
    vec2 p = gl_FragCoord.xy / 9.;
    float dark = i % 4 == 1 ? step(.8, fract(p.x + p.y)) : i % 4 == 2 ? step(.8, fract(p.x - p.y)) : i % 4 == 3 ? step(.8, fract(p.y)) : 0.;
    base *= 1. - .35 * dark;
  } else {
    float at = clamp(value / top, 0., 1.) * ${(colours.length - 1).toFixed(1)};
    int i = min(int(at), ${colours.length - 2});
    base = mix(scale[i], scale[i + 1], at - float(i));
    if (value > 1.005 * top) base = mix(vec3(.18, .06, .3), vec3(.4, .2, .6), step(.5, fract((gl_FragCoord.x - gl_FragCoord.y) / 8.)));
    if (step_ > 0.) {
      float f = value / step_, w = fwidth(f), d = abs(fract(f - .5) - .5) / max(w, 1e-6);
      base = mix(base, vec3(.1, .05, .05), .5 * (1. - smoothstep(.4, 1.3, d)) * step(w, .5) * step(.5, f));
    }
  }
  colour = vec4(base * min(light, 1.06), 1.);
}`;

class View {
  /* @throws where the browser has no WebGL 2 */
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error("no WebGL 2");
    const info = this.gl.getExtension("WEBGL_debug_renderer_info");
    const name = info ? String(this.gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
    this.isSoftware = /swiftshader|llvmpipe|software|basic render/i.test(name);
    this.surfaceProgram = this.#program(surfaceVertex, surfaceFragment);
    this.prepared = new Map();
  }

  #program(vertex, fragment) {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [kind, source] of [
      [gl.VERTEX_SHADER, vertex],
      [gl.FRAGMENT_SHADER, fragment],
    ]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const at = (name) => gl.getUniformLocation(program, name);
    return { program, at };
  }

  #texture(internal, format, type, width, height, values) {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, type, values);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
      gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    return texture;
  }

  /* A field that a pass writes, with 32 bits a number. */
  #target(rows) {
    const { gl } = this;
    const height = Math.ceil(rows / fieldWidth);
    const texture = this.#texture(gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, fieldWidth, height, null);
    const frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return { texture, frame, height };
  }

  #modes(modes, result) {
    const { gl } = this;
    const width = 2048;
    const texels = (modes.components * modes.padded) / 4;
    const perLine = Math.floor(width / texels);
    const height = Math.ceil(modes.rows / perLine);
    const values = new Int16Array(4 * width * height);
    for (let i = 0; i < modes.rows; i++)
      values.set(
        modes.values.subarray(4 * i * texels, 4 * (i + 1) * texels),
        4 * (Math.floor(i / perLine) * width + (i % perLine) * texels),
      );
    const texture = this.#texture(gl.RGBA16I, gl.RGBA_INTEGER, gl.SHORT, width, height, values);
    return {
      modes,
      texture,
      perLine,
      program: this.#program(wholeScreen, fieldShader(modes, result)),
      target: this.#target(modes.rows),
    };
  }

  prepare(body) {
    if (this.prepared.has(body)) return this.prepared.get(body);
    const { gl } = this;
    body.surface ||= new Surface(body);
    const { vertices } = body.surface;
    const height = Math.ceil(body.n / fieldWidth);
    const excluded = new Uint8Array(fieldWidth * height);
    excluded.set(body.excluded);
    const own = {
      stress: this.#modes(body.stress, length5),
      displacement: this.#modes(body.displacement, vector3),
      largest: this.#program(wholeScreen, largestShader(body.stress)),
      shown: this.#target(body.rows),
      excluded: this.#texture(gl.R8UI, gl.RED_INTEGER, gl.UNSIGNED_BYTE, fieldWidth, height, excluded),
      array: gl.createVertexArray(),
      lines: {},
    };
    gl.bindVertexArray(own.array);
    const enter = (place, data, set) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(place);
      set(place);
    };
    enter(0, vertices.position, (at) => gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 12, 0));
    enter(1, vertices.normal, (at) => gl.vertexAttribPointer(at, 3, gl.BYTE, true, 4, 0));
    enter(2, vertices.nodes, (at) => gl.vertexAttribIPointer(at, 4, gl.UNSIGNED_INT, 0, 0));
    for (const kind of ["triangles", "sharp", "rim"]) {
      own.lines[kind] = gl.createBuffer();
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, own.lines[kind]);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, vertices[kind], gl.STATIC_DRAW);
    }
    gl.bindVertexArray(null);
    this.prepared.set(body, own);
    return own;
  }

  /* Fills a texture by a shader, a fragment a row. */
  #fill({ program, at }, pass, target, set, line = 0, lines = target.height) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.viewport(0, 0, fieldWidth, target.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, line, fieldWidth, lines);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.useProgram(program);
    gl.bindVertexArray(null);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, pass.texture);
    gl.uniform1i(at("modes"), 0);
    gl.uniform1i(at("perLine"), pass.perLine);
    gl.uniform1i(at("rows"), pass.modes.rows);
    set(at);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  #instant(pass, t) {
    const { padded, factors } = pass.modes;
    this.#fill(pass.program, pass, pass.target, (at) =>
      this.gl.uniform4fv(at("factors"), factors.subarray(t * padded, (t + 1) * padded)),
    );
    return pass.target.texture;
  }

  #read(target, line, lines, rows, into) {
    const { gl } = this;
    const bits = new Uint32Array(4 * fieldWidth * lines);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.readPixels(0, line, fieldWidth, lines, gl.RGBA_INTEGER, gl.UNSIGNED_INT, bits);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const values = new Float32Array(bits.buffer);
    const first = line * fieldWidth;
    for (let i = first; i < Math.min(rows, first + lines * fieldWidth); i++)
      into[i] = values[4 * (i - first)];
  }

  /* The field of an instant, at all rows [Pa]. */
  field(body, t) {
    const own = this.prepare(body);
    const field = new Float32Array(body.rows);
    this.#instant(own.stress, t);
    this.#read(own.stress.target, 0, own.stress.target.height, body.rows, field);
    return field;
  }

  /* The largest over the cycle, a few lines of nodes at a time; `pause` lets others work and may end it. */
  async largest(body, pause) {
    const { gl } = this;
    const own = this.prepare(body);
    const { padded, factors } = body.stress;
    const texels = padded / 4;
    const height = Math.ceil(body.cycle.n / 64);
    const folded = new Float32Array(64 * padded * height);
    folded.set(factors);
    const course = this.#texture(gl.RGBA32F, gl.RGBA, gl.FLOAT, 64 * texels, height, folded);
    const target = this.#target(body.rows);
    const field = new Float32Array(body.rows);
    let isWhole = true;
    for (let line = 0; line < target.height && isWhole; line++) {
      this.#fill(
        own.largest,
        own.stress,
        target,
        (at) => {
          gl.activeTexture(gl.TEXTURE1);
          gl.bindTexture(gl.TEXTURE_2D, course);
          gl.uniform1i(at("course"), 1);
          gl.uniform1i(at("instants"), body.cycle.n);
        },
        line,
        1,
      );
      this.#read(target, line, 1, body.rows, field);
      isWhole = await pause((line + 1) / target.height);
    }
    gl.deleteTexture(course);
    gl.deleteTexture(target.texture);
    gl.deleteFramebuffer(target.frame);
    return isWhole ? field : null;
  }

  /* A field that was found elsewhere becomes the one that is drawn. */
  show(body, field) {
    const { gl } = this;
    const own = this.prepare(body);
    const values = new Float32Array(4 * fieldWidth * own.shown.height);
    for (let i = 0; i < body.rows; i++) values[4 * i] = field[i];
    gl.bindTexture(gl.TEXTURE_2D, own.shown.texture);
    gl.texSubImage2D(
      gl.TEXTURE_2D,
      0,
      0,
      0,
      fieldWidth,
      own.shown.height,
      gl.RGBA_INTEGER,
      gl.UNSIGNED_INT,
      new Uint32Array(values.buffer),
    );
  }

  /* @param scene  matrix, top and step of the colours, instant (null: the field of `show`), magnified, mesh,
     isGroup */
  draw(body, scene) {
    const { gl, canvas } = this;
    const own = this.prepare(body);
    const field = scene.instant === null ? own.shown.texture : this.#instant(own.stress, scene.instant);
    const moved =
      scene.magnified > 0 ? this.#instant(own.displacement, scene.instant) : own.displacement.target.texture;
    const sharpness = Math.min(devicePixelRatio, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) =>
      Math.max(1, Math.round(side * sharpness)),
    );
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const { program, at } = this.surfaceProgram;
    gl.useProgram(program);
    gl.bindVertexArray(own.array);
    [
      ["field", field],
      ["moved", moved],
      ["excluded", own.excluded],
    ].forEach(([name, texture], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(at(name), unit);
    });
    gl.uniform1i(at("count"), body.n);
    gl.uniform1i(at("mirrorAxis"), Math.max(0, body.keys.mirror_axis));
    gl.uniform1f(at("magnified"), scene.magnified);
    gl.uniformMatrix4fv(at("view"), false, scene.matrix);
    gl.uniform1f(at("top"), scene.top);
    gl.uniform1f(at("step_"), scene.step);
    gl.uniform1i(at("isGroup"), scene.isGroup ? 1 : 0);
    const pass = (kind, colour, nearer) => {
      gl.uniform4fv(at("line"), colour);
      gl.uniform1f(at("nearer"), nearer);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, own.lines[kind]);
      const shape = kind === "triangles" ? gl.TRIANGLES : gl.LINES;
      gl.drawElements(shape, body.surface.vertices[kind].length, gl.UNSIGNED_INT, 0);
    };
    pass("triangles", [0, 0, 0, 0], 0);
    if (scene.mesh) pass("rim", [0.1, 0.12, 0.16, 0.3], 0.0008);
    pass("sharp", [0.1, 0.12, 0.16, 0.65], 0.001);
    gl.bindVertexArray(null);
  }
}

/* A turntable: y is up, parallel projection, so that lengths are true. */
class Camera {
  constructor(canvas) {
    this.canvas = canvas;
    Object.assign(this, { yaw: 0.6, pitch: 0.3, at: [0, 0, 0], half: 1, depth: 1 });
  }

  axes(yaw = this.yaw, pitch = this.pitch) {
    const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
    return [
      [cy, 0, -sy],
      [-sy * sp, cp, -cy * sp],
      [sy * cp, sp, cy * cp],
    ];
  }

  matrix() {
    const [right, up, back] = this.axes();
    const wide = this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight);
    const rows = [
      right.map((v) => v / this.half / wide),
      up.map((v) => v / this.half),
      back.map((v) => -v / this.depth),
    ];
    const shift = rows.map((row) => -dot(row, this.at));
    return [0, 1, 2].flatMap((d) => [rows[0][d], rows[1][d], rows[2][d], 0]).concat(shift, 1);
  }

  /* Pixels right and down of the canvas's corner, and how near it is. */
  project(point) {
    const [right, up, back] = this.axes();
    const from = point.map((v, d) => v - this.at[d]);
    const { clientWidth, clientHeight } = this.canvas;
    const scale = clientHeight / 2 / this.half;
    return [
      clientWidth / 2 + dot(right, from) * scale,
      clientHeight / 2 - dot(up, from) * scale,
      dot(back, from),
    ];
  }

  slide(dx, dy) {
    const [right, up] = this.axes();
    const scale = (2 * this.half) / this.canvas.clientHeight;
    this.at = this.at.map((v, d) => v - (right[d] * dx - up[d] * dy) * scale);
  }

  /* Where all of a body is seen, from a direction. */
  whole(surface, yaw = this.yaw, pitch = this.pitch) {
    const middle = surface.low.map((v, d) => (v + surface.high[d]) / 2);
    const [right, up] = this.axes(yaw, pitch);
    let [wide, high] = [0, 0];
    for (let corner = 0; corner < 8; corner++) {
      const from = [0, 1, 2].map((d) => ((corner >> d) & 1 ? surface.high[d] : surface.low[d]) - middle[d]);
      wide = Math.max(wide, Math.abs(dot(right, from)));
      high = Math.max(high, Math.abs(dot(up, from)));
    }
    /* The colour scale stands to the left. */
    const aside = 110;
    const height = Math.max(1, this.canvas.clientHeight);
    const shape = Math.max(0.3, (this.canvas.clientWidth - aside) / height);
    const half = Math.max((wide / shape) * 1.06, high * 1.2);
    const shift = (aside * half) / height;
    return { yaw, pitch, at: middle.map((v, d) => v - right[d] * shift), half };
  }
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
