/* The body in three dimensions, drawn by the programs of living_shaders.js. */

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
