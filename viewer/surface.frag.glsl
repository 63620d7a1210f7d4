// SPDX-License-Identifier: GPL-3.0-or-later
// Fragment shader of triangles: color, isolines, parabolic lines, lighting.

#version 300 es
precision highp float;
in vec3 vPosition, vNormal, vConvex, vSaddle; in vec4 vStatus; in float vUndefined, vSide, vNoSide, vKept;
uniform sampler2D map; uniform bool isMapped; uniform vec3 plain, undefinedColor, regionColor;
uniform vec3 statusColors[4];
uniform float isolines[24], pixels; uniform int isolineCount; uniform bool hasSides;
out vec4 color;
void main() {
  if (vKept < 0.0) discard;
  // A quantity that is undefined where vSide is 0 is interpolated separately on each side of that line.
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
  bool hasLine = hasSides && vNoSide == 0.0;  // there is no line in a triangle with a corner of unknown side
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
}
