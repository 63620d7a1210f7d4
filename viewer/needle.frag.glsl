// SPDX-License-Identifier: GPL-3.0-or-later
// Fragment shader of needles.

#version 300 es
precision highp float;
in float vAcross, vHalf;
uniform bool isDark;
out vec4 color;
void main() {
  float r = abs(vAcross) / max(vHalf, 1e-6), core = 1.0 - smoothstep(0.35, 0.60, r);
  float edge = 1.0 - smoothstep(0.7, 1.0, r);
  color = vec4(vec3(isDark ? 0.1 + 0.9 * core : 1.0 - 0.9 * core), edge);
  color.rgb *= color.a;
}
