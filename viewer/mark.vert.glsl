// SPDX-License-Identifier: GPL-3.0-or-later
// Vertex shader of marks at vertices.

layout(location = 0) in vec3 position; layout(location = 3) in uint code;
uniform float size; uniform vec3 statusColors[4];
flat out vec3 vColor;
void main() {
  vColor = code >= 1u && code <= 4u ? statusColors[code - 1u] : vec3(0);
  gl_Position = projected(seen(position));
  gl_Position.z -= 1e-3 * gl_Position.w;
  if (kept(position) < 0.0) gl_Position = vec4(2, 2, 2, 1);  // outside of the view
  gl_PointSize = size;
}
