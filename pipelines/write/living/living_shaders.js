/* What the graphics card runs. A first pass makes the field at all nodes of the instant's factors, a fragment a
   node; the second draws the surface with it. Beside it the colours, which legends share. */

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
