// SPDX-License-Identifier: GPL-3.0-or-later
// Vertex shader of triangles.

layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal;
layout(location = 2) in float level; layout(location = 3) in uint code; layout(location = 4) in float side;
layout(location = 5) in float doubt; layout(location = 6) in uint hasNoSide;
out vec3 vPosition, vNormal, vConvex, vSaddle; out vec4 vStatus; out float vUndefined, vSide, vNoSide, vKept;
void main() {
  vPosition = seen(position);
  vNormal = turn * normal;
  // Only vertices with a number contribute to the interpolation.
  vec3 known = code == 0u ? vec3(level, 1, doubt) : vec3(0);
  vConvex = side >= 0.0 ? known : vec3(0);
  vSaddle = known - vConvex;
  vSide = side;
  vNoSide = float(hasNoSide);
  vKept = kept(position);
  vStatus = vec4(equal(uvec4(code), uvec4(1u, 2u, 3u, 4u)));
  vUndefined = float(code == 5u);
  gl_Position = projected(vPosition);
}
