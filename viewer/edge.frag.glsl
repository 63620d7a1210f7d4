// SPDX-License-Identifier: GPL-3.0-or-later
// Fragment shader of edges.

#version 300 es
precision highp float;
in float vKept;
out vec4 color;
void main() { if (vKept < 0.0) discard; color = vec4(0.0, 0.0, 0.0, 0.3); }
