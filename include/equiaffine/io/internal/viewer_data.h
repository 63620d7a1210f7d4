// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_VIEWER_DATA_H
#define EQUIAFFINE_IO_INTERNAL_VIEWER_DATA_H

#include <string_view>

/// \file
/// The page's script, first part: the arrays, what can be shown, and the color map of `io/color_map.h` in JavaScript
/// (the colors themselves are tables computed by that header).

namespace equiaffine::internal {

inline constexpr std::string_view viewer_data = R"js(
const byId = id => document.getElementById(id);
const facts = JSON.parse(byId('facts').textContent);

function takeBytes(id) {
  const node = byId(id), text = node.textContent;
  node.remove();
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

const mesh = {
  positions: new Float32Array(takeBytes('positions').buffer),
  triangles: new Uint32Array(takeBytes('triangles').buffer),
  status: takeBytes('status'),
};
mesh.size = mesh.positions.length / 3;

facts.columns.forEach((column, i) => {
  let values = null;
  column.values = () => values ??= new Float32Array(takeBytes('column-' + i).buffer);
});
const columnNamed = name => facts.columns.find(column => column.name === name);

// Three columns NAME_x, NAME_y, NAME_z (or nx, ny, nz) are a vector.
const vectorLabels = {
  n: 'Normal', conormal: 'Co-normal', affine_normal: 'Affine normal',
  direction1: 'Principal direction 1', direction2: 'Principal direction 2',
  affine_frame1: 'Affine frame, e₁', affine_frame2: 'Affine frame, e₂', affine_frame3: 'Affine frame, ξ',
};
const vectors = [];
for (const column of facts.columns) {
  const stem = /^(n|.+_)x$/.exec(column.name)?.[1];
  const parts = stem && ['x', 'y', 'z'].map(axis => columnNamed(stem + axis));
  if (!parts || parts.includes(undefined)) continue;
  const name = stem.replace(/_$/, '');
  vectors.push({name, parts, label: vectorLabels[name] ?? name, isLine: /^direction/.test(name)});
}

// Scalars; components of vectors and of the metric only when the page was asked for them.
function isOffered(column) {
  return !vectors.some(vector => vector.parts.includes(column)) && !/^metric_[xyz]{2}$/.test(column.name);
}
const plain = {name: 'plain', label: 'No color', group: 'Surface'};
const statusQuantity = {name: 'status', label: 'Status of the points', group: 'Surface'};
const quantities = facts.columns.filter(column => isOffered(column) || column.name === facts.color)
    .sort((a, b) => a.order - b.order);
if (mesh.status.length) quantities.push(statusQuantity);
quantities.push(plain);

// Calls use(first corner in `triangles`, normal with twice the face's area as length) for every face.
function faceNormals(p, triangles, use) {
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    use(t, uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
  }
}

// Unit normals: the attributes nx ny nz, where there are none the mean of the faces'.
function vertexNormals() {
  const {positions, triangles} = mesh, sums = new Float32Array(positions.length);
  faceNormals(positions, triangles, (t, x, y, z) => {
    for (let k = t; k < t + 3; ++k) {
      const i = 3 * triangles[k];
      sums[i] += x; sums[i + 1] += y; sums[i + 2] += z;
    }
  });
  const given = vectors.find(vector => vector.name === 'n')?.parts.map(part => part.values());
  const result = new Int16Array(4 * mesh.size);
  for (let i = 0; i < mesh.size; ++i) {
    let x = sums[3 * i], y = sums[3 * i + 1], z = sums[3 * i + 2];
    if (given && isFinite(given[0][i] + given[1][i] + given[2][i]))
      [x, y, z] = [given[0][i], given[1][i], given[2][i]];
    const scale = 32767 / (Math.hypot(x, y, z) || 1);
    result[4 * i] = x * scale; result[4 * i + 1] = y * scale; result[4 * i + 2] = z * scale;
  }
  return result;
}

// A third of the area of the faces around each vertex; equal shares for a mesh without area.
function vertexAreas() {
  const areas = new Float64Array(mesh.size);
  let total = 0;
  faceNormals(mesh.positions, mesh.triangles, (t, x, y, z) => {
    const share = Math.hypot(x, y, z) / 6;
    total += share;
    for (let k = t; k < t + 3; ++k) areas[mesh.triangles[k]] += share;
  });
  return total > 0 ? areas : areas.fill(1);
}

// The Gaussian curvature, scaled, 0 where the vertex is parabolic and NaN where it is not known, if the quantity
// does not exist where that changes its sign; else null.
function vertexSides(quantity) {
  const curvature = quantity.isUndefinedAtParabolicPoints && columnNamed('gaussian_curvature')?.values();
  if (!curvature) return null;
  const sides = curvature.map((value, i) => mesh.status[i] === 1 ? 0 : isFinite(value) ? value : NaN);
  const largest = sides.reduce((most, side) => isNaN(side) ? most : Math.max(most, Math.abs(side)), 0) || 1;
  return sides.map(side => side / largest);
}

// Whether the sides have different signs in a triangle where all three are known.
function hasParabolicLine(sides) {
  for (let t = 0; t < mesh.triangles.length; t += 3) {
    const corners = [0, 1, 2].map(k => sides[mesh.triangles[t + k]]);
    if (!corners.some(isNaN) && corners.some(side => side < 0) && corners.some(side => side >= 0)) return true;
  }
  return false;
}

// The estimated errors of a quantity, or undefined.
const errorsOf = quantity => columnNamed(quantity.name + '_error')?.values();

// color_doubt of io/trust.h.
function colorDoubt(value, error, range, isLog) {
  if (!isFinite(error)) return 1;
  const span = mapPosition(value + error, range, isLog) - mapPosition(value - error, range, isLog);
  return Math.min(1, 2 * span);
}

// What every vertex is drawn as: 0 by its number, 1 to 4 by its status, 5 because it has no number. With sides,
// parabolic vertices are those that a line is drawn through.
function vertexCodes(values, withStatus, sides) {
  const codes = new Uint8Array(mesh.size);
  if (withStatus) codes.set(mesh.status);
  else if (sides) mesh.status.forEach((status, i) => { codes[i] = Number(status === 1); });
  if (values)
    for (let i = 0; i < codes.length; ++i) if (codes[i] === 0 && !isFinite(values[i])) codes[i] = 5;
  return codes;
}

function quantile(sorted, percent) {
  const rank = percent / 100 * (sorted.length - 1), below = Math.floor(rank);
  if (below + 1 === sorted.length) return sorted[below];
  return sorted[below] + (rank - below) * (sorted[below + 1] - sorted[below]);
}

// color_range of io/color_map.h; both arrays sorted, finite.
function colorRange(sorted, magnitudes, clip, resolution) {
  const unit = resolution > 0 ? 1e9 * resolution : 1;
  const nothing = {lower: -unit, upper: unit, knee: unit, isDiverging: true};
  if (!sorted.length) return nothing;
  const largest = quantile(magnitudes, 100 - clip) || magnitudes[magnitudes.length - 1];
  const median = quantile(magnitudes, 50);
  if (median <= resolution && largest <= 1e3 * resolution) return nothing;
  const knee = Math.max(median, resolution, 1e-6 * largest);
  if (sorted[0] < -1e-6 * largest && sorted[sorted.length - 1] > 1e-6 * largest)
    return {lower: -largest, upper: largest, knee, isDiverging: true};
  const lower = quantile(sorted, clip), upper = quantile(sorted, 100 - clip);
  const middle = lower + (upper - lower) / 2;
  const halfWidth = Math.max((upper - lower) / 2, resolution, 1e-6 * Math.abs(middle));
  return {lower: middle - halfWidth, upper: middle + halfWidth, knee, isDiverging: false};
}

// A range that was typed: it depends on nothing else, so that two pages can share it.
const givenRange = (lower, upper) =>
    ({lower, upper, knee: Math.max(Math.abs(lower), Math.abs(upper)) / 100, isDiverging: lower === -upper});

// Whether preferred_scale of io/color_map.h is ASINH.
const prefersLog = range => Math.max(Math.abs(range.lower), Math.abs(range.upper)) > 100 * range.knee;

// The share of the way from the lower to the upper end of the range, not clipped. Clipped, this is map_position of
// io/color_map.h, with [-1, 1] of the diverging map brought to [0, 1].
function barPosition(value, range, isLog) {
  const scaled = isLog ? x => Math.asinh(x / range.knee) : x => x;
  const lower = scaled(range.lower);
  return (scaled(value) - lower) / (scaled(range.upper) - lower);
}
const mapPosition = (value, range, isLog) => Math.min(1, Math.max(0, barPosition(value, range, isLog)));

function colorAt(position, range) {
  const table = range.isDiverging ? facts.diverging : facts.sequential;
  return table[Math.round(position * (table.length - 1))];
}

// The numbers of the quantity that are colored as numbers, sorted, with everything that depends on them only.
function summarize(values, codes) {
  const shown = values.filter((value, i) => codes[i] === 0);
  return {sorted: shown.slice().sort(), magnitudes: shown.map(Math.abs).sort()};
}

// Round numbers inside the range, at most about `most` of them.
function ticks(range, isLog, most) {
  const result = [];
  if (!isLog) {
    const raw = (range.upper - range.lower) / most, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find(factor => factor * power >= raw * (1 - 1e-9));
    for (let k = Math.ceil(range.lower / step - 1e-6); k * step <= range.upper + 1e-6 * step; ++k)
      result.push(Number((k * step).toPrecision(12)));
    return result;
  }
  const largest = Math.max(Math.abs(range.lower), Math.abs(range.upper));
  const inside = value => value >= range.lower && value <= range.upper;
  const taken = [];
  const offer = value => {
    const place = barPosition(value, range, true);
    if (!inside(value) || taken.some(other => Math.abs(other - place) < 0.9 / most)) return;
    taken.push(place);
    result.push(value);
  };
  offer(0);
  for (let power = Math.floor(Math.log10(largest)); 10 ** power > range.knee / 10; --power)
    for (const factor of [1, 5, 2]) { offer(factor * 10 ** power); offer(-factor * 10 ** power); }
  return result.length > 1 ? result.sort((a, b) => a - b) : ticks(range, false, most);
}

const superscript = text => text.replace(/./g, c => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);
const powerOfTen = exponent => '10' + superscript(String(Number(exponent)));
// No digit beyond those asked for is shown: what has more places before the point gets a power of ten.
function readable(value, digits = 6) {
  if (Number.isNaN(value)) return '–';
  if (!isFinite(value)) return value > 0 ? '∞' : '−∞';
  const rounded = Number(value.toPrecision(digits)), places = rounded.toExponential().split('e')[1];
  return scientific(places >= digits || places < -5 ? rounded.toExponential() : String(rounded));
}
// With the digits that the estimated error leaves.
function readableWithin(value, error) {
  if (error === undefined || !isFinite(value)) return readable(value);
  if (!isFinite(error)) return 'not known';
  if (!(error > 0)) return readable(value);
  const place = number => Math.floor(Math.log10(Math.abs(number))), digits = place(value) - place(error) + 1;
  return (digits >= 1 ? readable(value, Math.min(digits, 6)) : '0') + ' ± ' + readable(error, 2);
}
function scientific(text) {
  const [mantissa, exponent] = text.split('e');
  const signed = mantissa.replace('-', '−');
  return exponent ? signed.replace(/^(−?)1$/, '$1').replace(/\d$/, '$&·') + powerOfTen(exponent) : signed;
}
)js";

} // namespace equiaffine::internal

#endif
