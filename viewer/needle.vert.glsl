// SPDX-License-Identifier: GPL-3.0-or-later
// Vertex shader of needles, which show vectors.

layout(location = 0) in vec3 base; layout(location = 1) in vec3 span;
uniform vec2 viewport; uniform float width; uniform bool hasHeads;
out float vAcross, vHalf;
// A strip of seven vertices: two at the base of the shaft, two at its end, two at the base of the head, and the tip.
const float places[4] = float[](0.0, 0.62, 0.62, 1.0), widths[4] = float[](1.0, 1.0, 2.6, 0.0);
void main() {
  int place = gl_VertexID / 2;
  float along = hasHeads ? places[place] : min(float(place), 1.0), side = float(gl_VertexID % 2) * 2.0 - 1.0;
  vec4 a = projected(seen(base)), b = projected(seen(base + span)), c = mix(a, b, along);
  vec2 way = (b.xy / b.w - a.xy / a.w) * viewport;
  vec2 across = length(way) > 0.0 ? normalize(vec2(-way.y, way.x)) : vec2(1, 0);
  vHalf = width * (hasHeads ? widths[place] : 1.0);
  vAcross = side * vHalf;
  gl_Position = c + vec4(vAcross * across / viewport * c.w, -5e-4 * c.w, 0);
  if (kept(base) < 0.0) gl_Position = vec4(2, 2, 2, 1);
}
