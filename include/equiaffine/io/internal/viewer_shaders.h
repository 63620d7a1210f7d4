// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_VIEWER_SHADERS_H
#define EQUIAFFINE_IO_INTERNAL_VIEWER_SHADERS_H

#include <string_view>

/// \file
/// The page's script, third part: the programs of the graphics processor.

namespace equiaffine::internal {

inline constexpr std::string_view viewer_shaders = R"js(
const placing = `#version 300 es
precision highp float;
uniform mat3 turn; uniform vec3 target;
uniform vec4 lens;  // horizontal and vertical scale, depth scale and shift
uniform float viewDistance;
uniform vec4 cut;  // what has a negative distance from this plane is cut off
float kept(vec3 p) { return cut.w - dot(cut.xyz, p); }
vec3 seen(vec3 p) { vec3 q = turn * (p - target); q.z -= viewDistance; return q; }
vec4 projected(vec3 q) { return vec4(lens.x * q.x, lens.y * q.y, lens.z * q.z + lens.w, -q.z); }
`;

const surfaceVertex = placing + `
layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal;
layout(location = 2) in float level; layout(location = 3) in uint code; layout(location = 4) in float side;
layout(location = 5) in float doubt; layout(location = 6) in uint hasNoSide;
out vec3 vPosition, vNormal, vConvex, vSaddle; out vec4 vStatus; out float vUndefined, vSide, vNoSide, vKept;
void main() {
  vPosition = seen(position);
  vNormal = turn * normal;
  // Only vertices with a number take part in the interpolation.
  vec3 known = code == 0u ? vec3(level, 1, doubt) : vec3(0);
  vConvex = side >= 0.0 ? known : vec3(0);
  vSaddle = known - vConvex;
  vSide = side;
  vNoSide = float(hasNoSide);
  vKept = kept(position);
  vStatus = vec4(equal(uvec4(code), uvec4(1u, 2u, 3u, 4u)));
  vUndefined = float(code == 5u);
  gl_Position = projected(vPosition);
}`;

const surfaceFragment = `#version 300 es
precision highp float;
in vec3 vPosition, vNormal, vConvex, vSaddle; in vec4 vStatus; in float vUndefined, vSide, vNoSide, vKept;
uniform sampler2D map; uniform bool isMapped; uniform vec3 plain, undefinedColor, regionColor;
uniform vec3 statusColors[4];
uniform float isolines[24], pixels; uniform int isolineCount; uniform bool hasSides;
out vec4 color;
void main() {
  if (vKept < 0.0) discard;
  // A number that does not exist where vSide is 0 is interpolated on each side of that line by itself.
  vec3 all = vConvex + vSaddle, same = vSide >= 0.0 ? vConvex : vSaddle, known = same.y > 0.0 ? same : all;
  float level = known.x / max(known.y, 1e-6), entries = float(textureSize(map, 0).x);
  float slope = fwidth(level);
  vec3 base = isMapped ? texture(map, vec2((0.5 + level * (entries - 1.0)) / entries, 0.5)).rgb : plain;
  vec3 light = pow(base, vec3(2.2));
  float doubted = known.z / max(known.y, 1e-6);
  base = pow(mix(light, vec3(dot(light, vec3(0.2126, 0.7152, 0.0722))), isMapped ? doubted : 0.0), vec3(1.0 / 2.2));
  float line = 0.0, most = all.y, parabolic = 0.0;
  for (int i = 0; i < isolineCount; ++i)
    if (slope > 1e-6) line = max(line, 1.0 - smoothstep(0.5, 1.3, abs(level - isolines[i]) / slope));
  bool hasLine = hasSides && vNoSide == 0.0;  // a triangle with a corner whose side is not known has none
  if (hasLine) parabolic = 1.0 - smoothstep(0.5, 1.0, abs(vSide) / max(fwidth(vSide) * pixels, 1e-30));
  base = mix(base, statusColors[0], parabolic);
  line *= 1.0 - parabolic;
  for (int i = hasLine && all.y > 0.0 ? 1 : 0; i < 4; ++i)
    if (vStatus[i] > most) { most = vStatus[i]; base = i == 0 ? regionColor : statusColors[i]; line = 0.0; }
  if (vUndefined > most) { base = undefinedColor; line = 0.0; }
  vec3 n = normalize(vNormal), view = normalize(-vPosition), lamp = normalize(vec3(-0.35, 0.5, 1.0));
  float side = gl_FrontFacing ? 1.0 : -1.0;
  float diffuse = 0.5 + 0.5 * side * dot(n, lamp);
  float shade = (0.36 + 0.67 * diffuse * diffuse) * (gl_FrontFacing ? 1.0 : 0.5);
  float glint = 0.03 * pow(max(dot(side * n, normalize(lamp + view)), 0.0), 40.0);
  vec3 linear = pow(mix(base, vec3(0.05), 0.75 * line), vec3(2.2)) * shade + glint;
  color = vec4(pow(linear, vec3(1.0 / 2.2)), 1);
}`;

const edgeVertex = placing + `
layout(location = 0) in vec3 position;
out float vKept;
void main() { gl_Position = projected(seen(position)); vKept = kept(position); }`;
const edgeFragment = `#version 300 es
precision highp float;
in float vKept;
out vec4 color;
void main() { if (vKept < 0.0) discard; color = vec4(0.0, 0.0, 0.0, 0.3); }`;

const markVertex = placing + `
layout(location = 0) in vec3 position; layout(location = 3) in uint code;
uniform float size; uniform vec3 statusColors[4];
flat out vec3 vColor;
void main() {
  vColor = code >= 1u && code <= 4u ? statusColors[code - 1u] : vec3(0);
  gl_Position = projected(seen(position));
  gl_Position.z -= 1e-3 * gl_Position.w;
  if (kept(position) < 0.0) gl_Position = vec4(2, 2, 2, 1);  // outside of the picture
  gl_PointSize = size;
}`;
const markFragment = `#version 300 es
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
}`;

const needleVertex = placing + `
layout(location = 0) in vec3 base; layout(location = 1) in vec3 span;
uniform vec2 viewport; uniform float width; uniform bool hasHeads;
out float vAcross, vHalf;
// A strip of seven vertices: both sides of the shaft at its begin and at its neck, the head there, and the tip.
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
}`;
const needleFragment = `#version 300 es
precision highp float;
in float vAcross, vHalf;
uniform bool isDark;
out vec4 color;
void main() {
  float r = abs(vAcross) / max(vHalf, 1e-6), core = 1.0 - smoothstep(0.35, 0.60, r);
  float edge = 1.0 - smoothstep(0.7, 1.0, r);
  color = vec4(vec3(isDark ? 0.1 + 0.9 * core : 1.0 - 0.9 * core), edge);
  color.rgb *= color.a;
}`;
)js";

} // namespace equiaffine::internal

#endif
