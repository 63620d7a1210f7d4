// SPDX-License-Identifier: GPL-3.0-or-later
// Vertex shader of edges.

layout(location = 0) in vec3 position;
out float vKept;
void main() { gl_Position = projected(seen(position)); vKept = kept(position); }
