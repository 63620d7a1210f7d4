// SPDX-License-Identifier: GPL-3.0-or-later
// Fragment shader of marks: discs and rings.

#version 300 es
precision highp float;
flat in vec3 vColor;
uniform bool isRing; uniform float opacity, size;
out vec4 color;
void main() {
  float r = length(gl_PointCoord - 0.5) * size, rim = 0.5 * size;
  float inside = 1.0 - smoothstep(rim - 1.0, rim, r);
  float dark = isRing ? smoothstep(0.48, 0.56, r / rim) * (1.0 - smoothstep(0.78, 0.86, r / rim)) : 0.0;
  float hole = isRing ? smoothstep(0.30, 0.40, r / rim) : 1.0;
  color = isRing ? vec4(mix(vec3(1), vec3(0.05), dark), inside * hole * opacity) : vec4(vColor, inside);
  color.rgb *= color.a;
}
