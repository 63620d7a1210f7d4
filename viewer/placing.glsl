// SPDX-License-Identifier: GPL-3.0-or-later
// The beginning of each vertex shader: transformation from the surface to the view.

#version 300 es
precision highp float;
uniform mat3 turn; uniform vec3 target;
uniform vec4 lens;  // horizontal and vertical scale, depth scale and shift
uniform float viewDistance;
uniform vec4 cut;  // points at a negative distance from this plane are cut off
float kept(vec3 p) { return cut.w - dot(cut.xyz, p); }
vec3 seen(vec3 p) { vec3 q = turn * (p - target); q.z -= viewDistance; return q; }
vec4 projected(vec3 q) { return vec4(lens.x * q.x, lens.y * q.y, lens.z * q.z + lens.w, -q.z); }
